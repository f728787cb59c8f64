#include "forces/motion_signal.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/dual.h"
#include "forces/support.h"

namespace wishbone {
namespace {

using testing::hinge;

TEST(MotionSignal, MeasuresGaugesAndComponents) {
  using enum MotionSignal::Quantity;
  const std::vector<MarkerState> markers = hinge(0.4, 3);
  const std::span<const MarkerState> all(markers);
  const double turn = 2 * std::numbers::pi;
  EXPECT_NEAR(MotionSignal("angle", 0, 1, {Gauge::Kind::rotation}, position).value(all, 3 * turn),
              0.4 + 3 * turn, 1e-13);
  EXPECT_NEAR(MotionSignal("rate", 0, 1, {Gauge::Kind::rotation}, speed).value(all, 0),
              markers[0].R_WM.col(2).dot(markers[1].w_WM - markers[0].w_WM), 1e-15);
  EXPECT_EQ(MotionSignal("height", 1, 2, position).value(all, 0), markers[1].p_WM.z());
  EXPECT_EQ(MotionSignal("lateral", 1, 1, speed).value(all, 0), markers[1].v_WM.y());
}

TEST(MotionSignal, CarriesDerivatives) {
  std::vector<MarkerStateT<Dual>> markers(2);
  markers[1].p_WM << 3.0, 4.0, 0.0;
  markers[1].p_WM.x().d[2] = 1;
  const MotionSignal distance("distance", 0, 1, {Gauge::Kind::distance}, MotionSignal::Quantity::position);
  const Dual u = distance.value(std::span<const MarkerStateT<Dual>>(markers), 0);
  EXPECT_DOUBLE_EQ(u.value, 5);
  EXPECT_DOUBLE_EQ(u.d[2], 0.6);
}

TEST(MotionSignal, OfADistanceThatIsZeroIsZeroAndItsRateThatOfParting) {
  using enum MotionSignal::Quantity;
  std::vector<MarkerStateT<Dual>> markers(2);
  markers[1].p_WM.x().d[0] = 1;
  const std::span<const MarkerStateT<Dual>> all(markers);
  const MotionSignal distance("distance", 0, 1, {Gauge::Kind::distance}, position);
  const MotionSignal rate("rate", 0, 1, {Gauge::Kind::distance}, speed);
  EXPECT_EQ(distance.value(all, 0).value, 0);
  EXPECT_EQ(distance.value(all, 0).d[0], 0);  // no derivative is claimed at the kink
  EXPECT_EQ(rate.value(all, 0).value, 0);
  markers[1].v_WM << -3.0, 4.0, 0.0;
  EXPECT_DOUBLE_EQ(rate.value(all, 0).value, 5);
}

TEST(MotionSignal, RejectsWhatCannotBeMeasured) {
  EXPECT_THROW(MotionSignal("gap", 2, 2, {Gauge::Kind::distance}, MotionSignal::Quantity::position),
               InputError);
  EXPECT_THROW(MotionSignal("height", 0, 3, MotionSignal::Quantity::position), InputError);
}

}  // namespace
}  // namespace wishbone
