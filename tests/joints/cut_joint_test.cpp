#include "joints/cut_joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "joints/closure_support.h"

namespace wishbone {
namespace {

using testing::acceleration;
using testing::carry;
using testing::moving;
using testing::Random;
using testing::random_acceleration;
using testing::random_coordinates;
using testing::random_marker;
using testing::random_scene;
using testing::rank;
using testing::rates;
using testing::residual;
using testing::Scene;
using testing::time_rate;
using testing::velocity_rows;
using testing::wrenches;

constexpr double kExact = 1e-12;
constexpr double kPitch = 0.13;
constexpr Gauge kAngle{Gauge::Kind::rotation};

/// A tree joint and the cut joint that leaves the same freedoms.
struct Twin {
  TreeJoint tree;
  CutJoint cut;
};

std::vector<Twin> twins() {
  return {{FixedJoint{}, FixedClosure{}},
          {RevoluteJoint{}, RevoluteClosure{}},
          {PrismaticJoint{}, PrismaticClosure{}},
          {ScrewJoint(Vector3::UnitZ(), kPitch), ScrewClosure(kPitch)},
          {CylindricalJoint{}, CylindricalClosure{}},
          {UniversalJoint{}, UniversalClosure{}},
          {ConstantVelocityJoint{}, ConstantVelocityClosure{}},
          {SphericalJoint{}, SphericalClosure{}},
          {PlanarJoint{}, PlanarClosure{}},
          {PrescribedJoint{PrescribedJoint::Kind::revolute, Vector3::UnitZ(), testing::some_motion()},
           DrivenClosure("drive", kAngle, testing::some_motion())},
          {PrescribedJoint{PrescribedJoint::Kind::prismatic, Vector3::UnitX(), testing::some_motion()},
           DrivenClosure("drive", {Gauge::Kind::translation, 0}, testing::some_motion())}};
}

/// A scene in which the tree joint holds B at random coordinates, and what it moves with.
Scene assembled(const Twin& twin, Random& random) {
  Scene scene = random_scene(twin.cut, random);
  std::visit(
      [&](const auto& j) {
        const VectorX q = random_coordinates(j, random);
        carry(j, q, random.numbers(j.kNv, 2), random.numbers(j.kNv, 2), scene);
        if (!scene.near.empty() && q.size() > 0) scene.near[0] = q[0] + random.uniform(-3, 3);
      },
      twin.tree);
  return scene;
}

template <class Law>
void for_every_twin(unsigned seed, Law law) {
  Random random(seed);
  for (int i = 0; i < 20; ++i)
    for (const Twin& twin : twins()) {
      SCOPED_TRACE(joint_kind(twin.cut));
      law(twin, random);
    }
}

/// Cut joints without a twin: their rows are what they claim in any pose.
std::vector<CutJoint> point_joints() {
  const Motion motion = testing::some_motion();
  return {PointOnLineClosure{}, PointOnPlaneClosure{}, DistanceClosure("rod", 1.3),
          DistanceClosure("ram", motion), DrivenClosure("drive", {Gauge::Kind::translation, 1}, motion)};
}

void expect_velocity_law(const CutJoint& joint, const Scene& scene) {
  const VectorX Phi_rate = rates(residual(joint, scene.t, moving(scene), scene.near));
  EXPECT_LT((velocity_rows(joint, scene.markers) - Phi_rate).norm(), kExact);
}

void expect_acceleration_law(const CutJoint& joint, const Scene& scene) {
  VectorX Phi_dd = rates(velocity_rows(joint, moving(scene)));
  if (const Motion* motion = drive(joint)) Phi_dd[0] -= motion->at(scene.t).acceleration;
  EXPECT_LT((acceleration(joint, scene) - Phi_dd).norm(), kExact * (1 + Phi_dd.norm()));
}

TEST(CutJoint, IsClosedWhereItsTreeTwinCarriesTheBody) {
  for_every_twin(20, [](const Twin& twin, Random& random) {
    const Scene scene = assembled(twin, random);
    EXPECT_LT(residual(twin.cut, scene.t, scene.markers, scene.near).norm(), 2e-14);
  });
}

TEST(CutJoint, LetsTheMotionOfItsTreeTwinPass) {
  for_every_twin(21, [](const Twin& twin, Random& random) {
    const Scene scene = assembled(twin, random);
    EXPECT_LT((velocity_rows(twin.cut, scene.markers) + time_rate(twin.cut, scene.t)).norm(), 1e-13);
    EXPECT_LT(acceleration(twin.cut, scene).norm(), kExact);
  });
}

TEST(CutJoint, TakesAwayTheFreedomsThatItsTreeTwinLeavesOut) {
  for_every_twin(22, [](const Twin& twin, Random& random) {
    const Scene scene = assembled(twin, random);
    const int rows = row_count(twin.cut);
    const MatrixX on_B = wrenches(twin.cut, scene.markers).rightCols(rows);
    EXPECT_EQ(rank(on_B), rows);
    if (!is_driven(twin.cut)) {
      EXPECT_EQ(6 - rows, speed_count(twin.tree));
    }
  });
}

TEST(CutJoint, WrenchesGiveTheRateOfTheResidualUnderAnyMotion) {
  for_every_twin(23, [](const Twin& twin, Random& random) {
    Scene scene = assembled(twin, random);
    for (MarkerState& s : scene.markers) {
      s.w_WM = random.vector(3);
      s.v_WM = random.vector(4);
    }
    expect_velocity_law(twin.cut, scene);
  });
  Random random(24);
  for (int i = 0; i < 20; ++i)
    for (const CutJoint& joint : point_joints()) expect_velocity_law(joint, random_scene(joint, random));
}

TEST(CutJoint, TheRateHoldsInEveryPoseUnlessTurnsAreMeasured) {
  Random random(25);
  for (int i = 0; i < 20; ++i)
    for (const Twin& twin : twins())
      if (gauge_count(twin.cut) == 0) {
        SCOPED_TRACE(joint_kind(twin.cut));
        expect_velocity_law(twin.cut, random_scene(twin.cut, random));
      }
}

TEST(CutJoint, AccelerationIsTheDerivativeOfTheRateInEveryPose) {
  Random random(26);
  for (int i = 0; i < 20; ++i) {
    for (const Twin& twin : twins()) {
      SCOPED_TRACE(joint_kind(twin.cut));
      expect_acceleration_law(twin.cut, random_scene(twin.cut, random));
    }
    for (const CutJoint& joint : point_joints()) expect_acceleration_law(joint, random_scene(joint, random));
  }
}

TEST(CutJoint, TimeRateIsThePartialDerivativeOfTheResidual) {
  Random random(27);
  const double h = 1e-5;
  for (const CutJoint& joint :
       {CutJoint(DrivenClosure("drive", kAngle, testing::some_motion())),
        CutJoint(DistanceClosure("ram", testing::some_motion())), CutJoint(DistanceClosure("rod", 2)),
        CutJoint(RevoluteClosure{}), CutJoint(ScrewClosure(kPitch))}) {
    const Scene s = random_scene(joint, random);
    const VectorX difference =
        residual(joint, s.t + h, s.markers, s.near) - residual(joint, s.t - h, s.markers, s.near);
    EXPECT_LT((difference / (2 * h) - time_rate(joint, s.t)).norm(), 1e-8);
  }
}

TEST(CutJoint, ActionEqualsReaction) {
  for_every_twin(28, [](const Twin& twin, Random& random) {
    const Scene scene = random_scene(twin.cut, random);
    const Matrix6X W = wrenches(twin.cut, scene.markers);
    const int rows = row_count(twin.cut);
    const Vector3 p_AB = scene.markers[1].p_WM - scene.markers[0].p_WM;
    for (int i = 0; i < rows; ++i) {
      const Vector6 on_A = W.col(i), on_B = W.col(rows + i);
      EXPECT_LT((on_A + shift_wrench(on_B, p_AB)).norm(), 1e-14);
    }
  });
}

TEST(CutJoint, DirectionsOfARevoluteStayInAAsItTurns) {
  Scene scene;
  scene.markers.resize(2);
  const Matrix6X start = wrenches(CutJoint(RevoluteClosure{}), scene.markers);
  scene.markers[1].R_WM = rotation_about(Vector3::UnitZ(), 1.1);
  EXPECT_LT((wrenches(CutJoint(RevoluteClosure{}), scene.markers) - start).norm(), 1e-15);
}

TEST(CutJoint, NamesItsRowsLengthsFirst) {
  const auto names = [](const CutJoint& joint) {
    std::string all;
    for (int i = 0; i < row_count(joint); ++i)
      all += std::string(i ? ", " : "") + row_direction(joint, i) + (row_is_angle(joint, i) ? "*" : "");
    return all;
  };
  EXPECT_EQ(names(RevoluteClosure{}), "x, y, z, tilt about y*, tilt about x*");
  EXPECT_EQ(names(FixedClosure{}), "x, y, z, turn about x*, turn about y*, turn about z*");
  EXPECT_EQ(names(ScrewClosure(1)), "x, y, travel, tilt about y*, tilt about x*");
  EXPECT_EQ(names(UniversalClosure{}), "x, y, z, tilt about z*");
  EXPECT_EQ(names(ConstantVelocityClosure{}), "x, y, z, twist*");
  EXPECT_EQ(names(PlanarClosure{}), "z, tilt about y*, tilt about x*");
  EXPECT_EQ(names(DistanceClosure("rod", 1)), "length");
  EXPECT_EQ(names(DrivenClosure("drive", kAngle, testing::some_motion())), "drive*");
}

TEST(OrientationLock, GrowsUpToHalfATurn) {
  Random random(29);
  const Vector3 axis = random.direction();
  std::vector<MarkerState> markers(2);
  for (const double angle : {0.0, 1e-9, 0.3, 1.5, 2.5, 3.1, -3.1}) {
    markers[0].R_WM = random.rotation();
    markers[1].R_WM = markers[0].R_WM * rotation_about(axis, angle);
    const VectorX Phi = residual(CutJoint(FixedClosure{}), 0, markers, {});
    EXPECT_LT((Phi.tail<3>() - 2 * std::sin(angle / 2) * axis).norm(), 2e-15);
  }
}

TEST(ScrewClosure, CountsWholeTurns) {
  std::vector<MarkerState> markers(2);
  const double angle = 5 * 2 * std::numbers::pi + 0.4;
  markers[1].R_WM = rotation_about(Vector3::UnitZ(), angle);
  markers[1].p_WM = Vector3(0, 0, kPitch * angle);
  const CutJoint screw = ScrewClosure(kPitch);
  EXPECT_LT(residual(screw, 0, markers, {angle - 1}).norm(), 1e-14);
  EXPECT_NEAR(residual(screw, 0, markers, {0.0})[2], kPitch * 5 * 2 * std::numbers::pi, 1e-14);
}

TEST(DistanceClosure, IsTheLengthBeyondThatOfTheRod) {
  std::vector<MarkerState> markers(2);
  markers[1].p_WM = Vector3(2, 3, 6);
  EXPECT_DOUBLE_EQ(residual(CutJoint(DistanceClosure("rod", 5)), 0, markers, {0.0})[0], 2);
  EXPECT_FALSE(is_driven(DistanceClosure("rod", 5)));
  EXPECT_TRUE(is_driven(DistanceClosure("ram", testing::some_motion())));
}

TEST(DistanceClosure, NeedsALengthAndPointsApart) {
  EXPECT_THROW(DistanceClosure("rod", 0), InputError);
  EXPECT_THROW(DistanceClosure("rod", -1), InputError);
  EXPECT_THROW(DistanceClosure("rod", std::nan("")), InputError);
  const CutJoint rod = DistanceClosure("rod", 1);
  const Scene together{std::vector<MarkerState>(2), std::vector<MarkerAcceleration>(2), {0.0}};
  EXPECT_THROW(residual(rod, 0, together.markers, {0.0}), NumericsError);
  EXPECT_THROW(wrenches(rod, together.markers), NumericsError);
  EXPECT_THROW(acceleration(rod, together), NumericsError);
}

TEST(DrivenClosure, DrivesBothAnglesOfAUniversalJoint) {
  Random random(30);
  const Motion motion = testing::some_motion();
  for (const Gauge::Kind kind : {Gauge::Kind::universal_first, Gauge::Kind::universal_second}) {
    const CutJoint drive = DrivenClosure("drive", {kind}, motion);
    Scene scene = random_scene(drive, random);
    VectorX q = random.numbers(2, 1.2);
    const int driven = kind == Gauge::Kind::universal_first ? 0 : 1;
    q[driven] = motion.at(scene.t).position;
    carry(UniversalJoint{}, q, random.numbers(2, 1), random.numbers(2, 1), scene);
    EXPECT_LT(residual(drive, scene.t, scene.markers, {0.0}).norm(), 1e-14);
    expect_velocity_law(drive, scene);
    expect_acceleration_law(drive, scene);
  }
}

}  // namespace
}  // namespace wishbone
