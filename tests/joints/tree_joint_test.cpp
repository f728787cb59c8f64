#include "joints/tree_joint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "joints/support.h"

namespace wishbone {
namespace {

using testing::across;
using testing::all_tree_joints;
using testing::Drift;
using testing::drift;
using testing::dual;
using testing::moving;
using testing::Random;
using testing::random_coordinates;
using testing::rates;
using testing::unskew;
using testing::values;

constexpr double kTime = 0.7;
constexpr double kExact = 1e-12;

/// Calls law(joint) for every tree joint, many times with axes of its own.
template <class Law>
void for_every_joint(unsigned seed, Law law) {
  Random random(seed);
  for (int i = 0; i < 20; ++i)
    for (const TreeJoint& joint : all_tree_joints(random)) {
      SCOPED_TRACE(joint_kind(joint));
      std::visit([&](const auto& j) { law(j, random); }, joint);
    }
}

/// (w_FM, v_FM) in F: R' = w~ R.
template <class Across>
Vector6 velocity(const Across& moving_pose) {
  const Matrix3 R = values(moving_pose.X_FM.R);
  return spatial(unskew(rates(moving_pose.X_FM.R) * R.transpose()), rates(moving_pose.X_FM.p));
}

TEST(TreeJoint, VelocityIsTheDerivativeOfThePose) {
  for_every_joint(1, [](const auto& joint, Random& random) {
    const VectorX q = random_coordinates(joint, random), v = random.numbers(joint.kNv, 3);
    const Vector6 Hv = across(joint, kTime, q).H * v;
    EXPECT_LT((velocity(across(joint, kTime, moving(joint, q, v))) - Hv).norm(), kExact);
  });
}

TEST(TreeJoint, DriftIsTheAccelerationAtConstantSpeeds) {
  for_every_joint(2, [](const auto& joint, Random& random) {
    if (std::string(joint.kKind) == "prescribed") return;  // its drift comes from time, not from coordinates
    const VectorX q = random_coordinates(joint, random), v = random.numbers(joint.kNv, 3);
    const Drift d = drift(joint, kTime, q, v);
    const auto H_moving = across(joint, kTime, moving(joint, q, v)).H;
    const Vector6 A = rates(H_moving) * v;
    EXPECT_EQ(d.V, Vector6::Zero());
    EXPECT_LT((d.A - A).norm(), kExact);
  });
}

TEST(TreeJoint, PrescribedMovesAsTheFreeJointThatFollowsTheMotion) {
  Random random(3);
  const Vector3 axis = random.direction();
  const Motion motion = testing::some_motion();
  const MotionValue u = motion.at(kTime);
  const VectorX q = VectorX::Constant(1, u.position), v = VectorX::Constant(1, u.rate);
  const auto check = [&](const auto& joint, PrescribedJoint::Kind kind) {
    const PrescribedJoint prescribed{kind, axis, motion};
    const auto free = across(joint, kTime, q);
    const auto driven = across(prescribed, kTime, VectorX(0));
    const Drift d = drift(prescribed, kTime, VectorX(0), VectorX(0));
    EXPECT_LT((free.X_FM.R - driven.X_FM.R).norm() + (free.X_FM.p - driven.X_FM.p).norm(), 1e-15);
    EXPECT_LT((d.V - free.H * u.rate).norm(), 1e-15);
    EXPECT_LT((d.A - free.H * u.acceleration).norm(), 1e-15);
  };
  check(RevoluteJoint(axis), PrescribedJoint::Kind::revolute);
  check(PrismaticJoint(axis), PrescribedJoint::Kind::prismatic);
}

Pose pose(const TreeJoint& joint, const VectorX& q) {
  return std::visit([&](const auto& j) { return across(j, kTime, q).X_FM; }, joint);
}

TEST(TreeJoint, ReverseIsTheInverseMotionInTheSameCoordinates) {
  Random random(4);
  for (int i = 0; i < 10; ++i)
    for (const TreeJoint& joint : all_tree_joints(random)) {
      SCOPED_TRACE(joint_kind(joint));
      const VectorX q = std::visit([&](const auto& j) { return random_coordinates(j, random); }, joint);
      const TreeJoint back = reverse(joint);
      const Pose X = pose(joint, q), round_trip = pose(back, q) * X, again = pose(reverse(back), q);
      EXPECT_LT((round_trip.R - Matrix3::Identity()).norm() + round_trip.p.norm(), 1e-14);
      EXPECT_LT((again.R - X.R).norm() + (again.p - X.p).norm(), 1e-14);
      EXPECT_STREQ(joint_kind(back), joint_kind(joint));
    }
}

TEST(TreeJoint, ReverseOfAPrescribedJointRunsBackwards) {
  Random random(5);
  const PrescribedJoint joint{PrescribedJoint::Kind::revolute, random.direction(), testing::some_motion()};
  const Drift there = drift(joint, kTime, VectorX(0), VectorX(0));
  const Drift back = drift(joint.reversed(), kTime, VectorX(0), VectorX(0));
  EXPECT_EQ(back.V, -there.V);
  EXPECT_EQ(back.A, -there.A);
}

TEST(TreeJoint, DisplacementIsTheInverseOfRetraction) {
  for_every_joint(6, [](const auto& joint, Random& random) {
    const VectorX q0 = random_coordinates(joint, random), d = random.numbers(joint.kNv, 1.5);
    VectorX q = q0, d_found(joint.kNv);
    joint.retract(d.data(), q.data());
    joint.calc_displacement(q0.data(), q.data(), d_found.data());
    EXPECT_LT((d_found - d).norm(), kExact);
  });
}

TEST(TreeJoint, RetractionMovesAlongTheSpeedsToFirstOrder) {
  for_every_joint(7, [](const auto& joint, Random& random) {
    const VectorX q = random_coordinates(joint, random), v = random.numbers(joint.kNv, 1);
    const double h = 1e-4;
    VectorX forth = q, back = q, q_rate(joint.kNq);
    const VectorX d = h * v, minus_d = -d;
    joint.retract(d.data(), forth.data());
    joint.retract(minus_d.data(), back.data());
    joint.calc_q_rate(q.data(), v.data(), q_rate.data());
    EXPECT_LT(((forth - back) / (2 * h) - q_rate).norm(), 1e-8);
  });
}

TEST(TreeJoint, NeutralCoordinatesGiveTheIdentity) {
  for_every_joint(8, [](const auto& joint, Random& /*random*/) {
    if (std::string(joint.kKind) == "prescribed") return;
    VectorX q(joint.kNq);
    joint.set_neutral(q.data());
    const Pose X = across(joint, kTime, q).X_FM;
    EXPECT_EQ(X.R, Matrix3::Identity());
    EXPECT_EQ(X.p, Vector3::Zero());
  });
}

TEST(ConstantVelocityJoint, TurnsAboutItsRotationVector) {
  Random random(9);
  // through zero, the border of the series at one, and up to half a turn
  for (const double angle : {0.0, 1e-200, 1e-9, 1e-4, 0.3, 1 - 1e-14, 1 + 1e-14, 2.0, 3.1}) {
    const Vector3 axis = random.direction();
    const ConstantVelocityJoint joint(axis);
    const double heading = random.uniform(-3, 3);
    const VectorX q = angle * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    const Vector3 about = std::cos(heading) * joint.first_F + std::sin(heading) * joint.second_F;
    EXPECT_LT((across(joint, 0, q).X_FM.R - rotation_about(about, angle)).norm(), 2e-15);
    EXPECT_LT((joint.axis_F() - axis).norm(), 1e-15);
  }
}

TEST(ConstantVelocityJoint, IsSmoothThroughZeroAndAcrossTheBorderOfItsSeries) {
  Random random(10);
  const ConstantVelocityJoint joint;
  for (const double angle : {0.0, 1e-12, 1e-5, 0.999999, 1.000001}) {
    const VectorX q = angle * Eigen::Vector2d(0.6, 0.8), v = random.numbers(2, 3);
    const auto m = across(joint, 0, moving(joint, q, v));
    EXPECT_LT((velocity(m) - values(m.H) * v).norm(), kExact);
    EXPECT_LT((rates(m.H) * v - drift(joint, 0, q, v).A).norm(), kExact);
  }
}

TEST(ConstantVelocityJoint, BothShaftsSpinAlike) {
  Random random(11);
  for (int i = 0; i < 20; ++i) {
    const ConstantVelocityJoint joint(random.direction());
    const VectorX q = random_coordinates(joint, random), v = random.numbers(2, 3);
    const auto m = across(joint, 0, q);
    const Vector3 w = m.H.topRows<3>() * v, shaft_F = joint.axis_F(), shaft_M = m.X_FM.R * shaft_F;
    // no relative velocity along the bisector: spins s_F, s_M of the shafts at constant bend satisfy s_F = s_M
    EXPECT_NEAR(w.dot(shaft_F + shaft_M), 0, kExact);
  }
}

TEST(UniversalJoint, ItsArmsStayPerpendicular) {
  Random random(12);
  const auto [first, second] = perpendiculars(random.direction());
  const UniversalJoint joint(first, second);
  for (int i = 0; i < 20; ++i) {
    const Pose X = across(joint, 0, random_coordinates(joint, random)).X_FM;
    EXPECT_NEAR(first.dot(X.R * second), 0, 1e-15);
  }
}

TEST(ScrewJoint, ARightHandedThreadIsRightHandedFromBothSides) {
  const ScrewJoint joint(Vector3::UnitX(), 0.25);
  const Pose X = across(joint, 0, VectorX(VectorX::Constant(1, 2.0))).X_FM;
  EXPECT_EQ(X.p, Vector3(0.5, 0, 0));
  EXPECT_LT((X.R * Vector3::UnitY() - Vector3(0, std::cos(2), std::sin(2))).norm(), 1e-15);
  EXPECT_EQ(joint.reversed().pitch, 0.25);
}

}  // namespace
}  // namespace wishbone
