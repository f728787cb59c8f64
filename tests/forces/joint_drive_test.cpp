#include "forces/joint_drive.h"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>

#include "core/dual.h"
#include "forces/motion_signal.h"
#include "forces/support.h"

namespace wishbone {
namespace {

using testing::Random;
using testing::rotation;

Function expression(const std::string& text) {
  return Function(Expression(text, {"t", "rate"}));
}

/// Two markers anywhere in any motion, whose z axes agree, turned by u.
std::vector<MarkerState> hinge(double u, unsigned seed) {
  Random random(seed);
  std::vector<MarkerState> markers(2);
  for (MarkerState& m : markers)
    m = {Matrix3::Identity(), random.vector(1), random.vector(2), random.vector(3)};
  markers[0].R_WM = rotation(random.vector(1), random.uniform(-3, 3));
  markers[1].R_WM = markers[0].R_WM * rotation(Vector3::UnitZ(), u);
  return markers;
}

TEST(JointDrive, PositiveTorqueTurnsTheSecondForwardAndTheFirstBack) {
  const JointDrive motor("motor", 0, 1, {Gauge::Kind::rotation}, expression("3*t - 2*rate"));
  const std::vector<MarkerState> markers = hinge(0.4, 1);
  const std::vector<double> variables{2, 0.5};
  std::vector<Wrench> wrenches(2);
  ForceOutput output{wrenches, {}};
  const ForceInput input{2, markers, {}, 0, 0, variables};
  motor.apply(input, output);
  EXPECT_NEAR(markers[0].R_WM.col(2).dot(wrenches[1].t), 5, 1e-13);
  EXPECT_LT((wrenches[0].t + wrenches[1].t).norm(), 1e-13);
  EXPECT_DOUBLE_EQ(motor.output(input).force, 5);
  EXPECT_THAT(motor.variables(), ::testing::ElementsAre(0, 1));
}

TEST(JointDrive, ItsPowerIsThatOfItsWrenches) {
  for (const auto kind : {Gauge::Kind::rotation, Gauge::Kind::translation, Gauge::Kind::distance}) {
    const JointDrive drive("drive", 0, 1, {kind, 1}, 7.0);
    for (unsigned seed = 1; seed < 20; ++seed) {
      const std::vector<MarkerState> markers = hinge(1.1, seed);
      const testing::Applied a = testing::applied(drive, markers);
      double power = 0;
      for (std::size_t i = 0; i < 2; ++i)
        power += a.wrenches[i].f.dot(markers[i].v_WM) + a.wrenches[i].t.dot(markers[i].w_WM);
      EXPECT_NEAR(a.power, power, 1e-11);
    }
  }
}

TEST(JointDrive, RejectsWhatIsNoForce) {
  EXPECT_THROW(JointDrive("motor", 0, 1, {}, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(JointDrive("motor", 1, 1, {}, 1.0), InputError);
}

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

TEST(MotionSignal, RejectsWhatCannotBeMeasured) {
  EXPECT_THROW(MotionSignal("gap", 2, 2, {Gauge::Kind::distance}, MotionSignal::Quantity::position),
               InputError);
  EXPECT_THROW(MotionSignal("height", 0, 3, MotionSignal::Quantity::position), InputError);
}

}  // namespace
}  // namespace wishbone
