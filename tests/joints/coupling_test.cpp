#include "joints/coupling.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "joints/closure_support.h"

namespace wishbone {
namespace {

using testing::acceleration;
using testing::moving;
using testing::Random;
using testing::rates;
using testing::residual;
using testing::Scene;
using testing::velocity_rows;

constexpr Gauge kTurn{Gauge::Kind::rotation};
constexpr Gauge kTravel{Gauge::Kind::translation, 0};

TEST(Coupling, GearsTurnInTheRatioOfTheirTeethThroughManyTurns) {
  // 20 and 60 teeth outside each other: 20 u1 + 60 u2 = 0
  const CutJoint gears = CouplingClosure("gears", {{kTurn, 20}, {kTurn, 60}});
  ASSERT_EQ(participant_count(gears), 4);
  ASSERT_EQ(gauge_count(gears), 2);
  EXPECT_TRUE(row_is_angle(gears, 0));
  std::vector<MarkerState> markers(4);
  for (double u = 0; u < 40; u += 0.7) {
    markers[1].R_WM = rotation_about(Vector3::UnitZ(), u);
    markers[3].R_WM = rotation_about(Vector3::UnitZ(), -u / 3);
    EXPECT_NEAR(residual(gears, 0, markers, {u - 0.7, -u / 3 + 0.5})[0], 0, 1e-12);
  }
}

TEST(Coupling, PinionDrivesTheRackByItsRadius) {
  const double radius = 0.02;
  const CutJoint rack = CouplingClosure("rack", {{kTravel, 1}, {kTurn, -radius}}, 0.1);
  EXPECT_FALSE(row_is_angle(rack, 0));
  std::vector<MarkerState> markers(4);
  markers[1].p_WM = Vector3(0.1 + radius * 1.5, 7, 8);
  markers[3].R_WM = rotation_about(Vector3::UnitZ(), 1.5);
  EXPECT_NEAR(residual(rack, 0, markers, {0, 0})[0], 0, 1e-16);
  // a unit multiplier pushes the rack and turns the pinion back by the lever
  const Matrix6X W = testing::wrenches(rack, markers);
  EXPECT_LT((W.col(1).tail<3>() - Vector3::UnitX()).norm(), 1e-15);
  EXPECT_LT((W.col(3).head<3>() + radius * Vector3::UnitZ()).norm(), 1e-15);
}

TEST(Coupling, RatesAndAccelerationsFollowFromItsGauges) {
  Random random(31);
  const CutJoint mixer = CouplingClosure(
      "mixer",
      {{kTravel, 1.5}, {kTurn, -0.2}, {{Gauge::Kind::distance}, 0.7}, {{Gauge::Kind::translation, 2}, -1}});
  for (int i = 0; i < 20; ++i) {
    Scene scene = testing::random_scene(mixer, random);
    // the law of the rate holds with aligned axes
    scene.markers[3].R_WM = scene.markers[2].R_WM * rotation_about(Vector3::UnitZ(), random.uniform(-3, 3));
    const VectorX Phi_rate = rates(residual(mixer, 0, moving(scene), scene.near));
    EXPECT_NEAR(velocity_rows(mixer, scene.markers)[0], Phi_rate[0], 1e-12);
    const VectorX Phi_dd = rates(velocity_rows(mixer, moving(scene)));
    EXPECT_NEAR(acceleration(mixer, scene)[0], Phi_dd[0], 1e-12 * (1 + Phi_dd.norm()));
  }
}

TEST(Coupling, RejectsWhatCouplesNothing) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(CouplingClosure("gears", {}), InputError);
  EXPECT_THROW(CouplingClosure("gears", {{kTurn, 1}, {kTurn, 0}}), InputError);
  EXPECT_THROW(CouplingClosure("gears", {{kTurn, infinity}}), InputError);
  EXPECT_THROW(CouplingClosure("gears", {{kTurn, 1}}, infinity), InputError);
  const CutJoint rope =
      CouplingClosure("rope", {{{Gauge::Kind::distance}, 1}, {{Gauge::Kind::distance}, 1}}, 3);
  EXPECT_THROW(residual(rope, 0, std::vector<MarkerState>(4), {0, 0}), NumericsError);
}

}  // namespace
}  // namespace wishbone
