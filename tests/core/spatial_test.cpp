#include "core/spatial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace wishbone {
namespace {

class Spatial : public testing::Test {
 protected:
  double number() { return std::uniform_real_distribution(-1.0, 1.0)(random_); }
  Vector3 vector() { return {number(), number(), number()}; }
  Quaternion rotation() { return Quaternion(number(), number(), number(), number()).normalized(); }
  Pose pose() { return {rotation().toRotationMatrix(), vector()}; }
  Vector6 six() { return spatial(vector(), vector()); }
  /// Inertia about the body origin of a random rigid body.
  Matrix6 inertia() {
    Matrix6 I = Matrix6::Zero();
    for (int i = 0; i < 5; ++i) {  // five particles: J = -sum m p~ p~, h = sum m p~
      const double m = 1.5 + number();
      const Matrix3 p = skew(vector());
      I.topLeftCorner<3, 3>() -= m * p * p;
      I.topRightCorner<3, 3>() += m * p;
      I.bottomLeftCorner<3, 3>() -= m * p;
      I.bottomRightCorner<3, 3>() += m * Matrix3::Identity();
    }
    return I;
  }
  std::mt19937 random_{11};
};

constexpr double kRounding = 1e-14;

Eigen::Vector4d wxyz(const Quaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

TEST_F(Spatial, RotationVectorObeysRodrigues) {
  for (const double angle : {1e-9, 9.9e-5, 1.01e-4, 0.3, 2.0, 3.1}) {
    const Vector3 axis = vector().normalized();
    const Matrix3 a = skew(axis);
    // R = 1 + sin(angle) a~ + (1 - cos(angle)) a~^2
    const double half = std::sin(angle / 2);
    const Matrix3 R = Matrix3::Identity() + std::sin(angle) * a + 2 * half * half * a * a;
    const Quaternion q = quaternion_from_rotation_vector(angle * axis);
    EXPECT_NEAR(q.norm(), 1, kRounding);
    EXPECT_LT((q.toRotationMatrix() - R).norm(), kRounding) << angle;
  }
  EXPECT_EQ(quaternion_from_rotation_vector(Vector3::Zero()).w(), 1);
}

TEST_F(Spatial, RotationDoesNotDependOnTheLengthOfTheQuaternion) {
  const Quaternion q = rotation();
  EXPECT_LT((rotation_from_quaternion(3.7 * wxyz(q)) - q.toRotationMatrix()).norm(), kRounding);
  EXPECT_LT((rotation_from_quaternion(-wxyz(q)) - q.toRotationMatrix()).norm(), kRounding);
}

TEST_F(Spatial, QuaternionRateTurnsTheRotationMatrix) {
  // R' = R w~ with w in the moving frame; the quaternion is advanced by the exact exponential of a constant
  // rate.
  const Quaternion q = rotation();
  const Vector3 w = vector();
  const Matrix3 R_rate = q.toRotationMatrix() * skew(w);
  double last_error = 0;
  for (const double h : {1e-2, 5e-3}) {
    const Eigen::Vector4d moved = wxyz(q) + h * quaternion_rate(wxyz(q), w);
    const Quaternion exact = q * quaternion_from_rotation_vector(h * w);
    const double error = (moved - wxyz(exact)).norm();
    if (last_error > 0) {
      EXPECT_NEAR(std::log2(last_error / error), 2, 0.02);  // one Euler step: O(h^2)
    }
    last_error = error;
    const Matrix3 difference = ((q * quaternion_from_rotation_vector(h * w)).toRotationMatrix() -
                                (q * quaternion_from_rotation_vector(-h * w)).toRotationMatrix()) /
                               (2 * h);
    EXPECT_LT((difference - R_rate).norm(), h * h);
  }
  EXPECT_NEAR(wxyz(q).dot(quaternion_rate(wxyz(q), w)), 0, kRounding);  // the norm stays
}

TEST_F(Spatial, PosesFormAGroup) {
  const Pose X_AB = pose(), X_BC = pose();
  const Vector3 p_CQ = vector();
  EXPECT_LT(((X_AB * X_BC) * p_CQ - X_AB * (X_BC * p_CQ)).norm(), kRounding);
  const Pose identity = X_AB * X_AB.inverse();
  EXPECT_LT((identity.R - Matrix3::Identity()).norm() + identity.p.norm(), kRounding);
}

TEST_F(Spatial, SkewIsTheCrossProduct) {
  const Vector3 a = vector(), b = vector();
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), kRounding);
}

TEST_F(Spatial, ShiftedVelocityIsThatOfTheRigidBody) {
  // A wheel of radius 2 that rolls along x: about +y, with the contact point at rest.
  const Vector6 V_centre = spatial({0, 3, 0}, {6, 0, 0});
  EXPECT_EQ(shift_velocity(V_centre, {0, 0, -2}), spatial({0, 3, 0}, {0, 0, 0}));
  EXPECT_EQ(shift_velocity(V_centre, {0, 0, 2}), spatial({0, 3, 0}, {12, 0, 0}));
}

TEST_F(Spatial, PowerAndKineticEnergyDoNotDependOnTheReferencePoint) {
  for (int i = 0; i < 20; ++i) {
    const Vector3 p_PB = vector();
    const Vector6 V_P = six(), F_B = six();
    const Vector6 V_B = shift_velocity(V_P, p_PB);
    EXPECT_NEAR(shift_wrench(F_B, p_PB).dot(V_P), F_B.dot(V_B), kRounding * 10);
    const Matrix6 I_B = inertia();
    Matrix6 I_P = Matrix6::Zero();
    add_shifted_inertia(I_B, p_PB, I_P);
    EXPECT_NEAR(V_P.dot(I_P * V_P), V_B.dot(I_B * V_B), kRounding * 100);
    EXPECT_LT((I_P - I_P.transpose()).norm(), kRounding * 100);
    Matrix6 back = -I_B;
    add_shifted_inertia(I_P, -p_PB, back);
    EXPECT_LT(back.norm(), kRounding * 100);
  }
}

TEST_F(Spatial, PerpendicularsCompleteARightHandedTriad) {
  for (int i = 0; i < 50; ++i) {
    const Vector3 axis = i < 3 ? Vector3(Vector3::Unit(i)) : vector().normalized();
    const auto [first, second] = perpendiculars(axis);
    Matrix3 triad;
    triad << axis, first, second;
    EXPECT_LT((triad.transpose() * triad - Matrix3::Identity()).norm(), kRounding);
    EXPECT_NEAR(triad.determinant(), 1, kRounding);
  }
}

}  // namespace
}  // namespace wishbone
