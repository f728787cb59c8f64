#include "core/rotation_vector.h"

#include <gtest/gtest.h>

#include "core/dual.h"

namespace wishbone {
namespace {

constexpr double kTurnRounding = 1e-14;

const Vector3 kAxis = Vector3(2, -1, 0.5).normalized();
const Vector3 kRate(0.7, 1.9, -1.3);
const std::initializer_list<double> kAngles{0, 1e-9, 1e-3, 0.4, 0.99, 1.01, 2.5, 6};

/// A vector that moves: value and its rate along the first direction.
Vector3T<Dual> moving(const Vector3& value, const Vector3& rate) {
  Vector3T<Dual> v = value.cast<Dual>();
  for (int i = 0; i < 3; ++i) v[i].d[0] = rate[i];
  return v;
}
template <class D>
auto rate_of(const Eigen::MatrixBase<D>& m) {
  return m.unaryExpr([](const Dual& a) { return a.d[0]; }).eval();
}

TEST(RotationVector, TurnsAboutItsAxisByItsLength) {
  for (const double angle : kAngles)
    EXPECT_LT((RotationVector<double>(angle * kAxis).R - rotation_about(kAxis, angle)).norm(), kTurnRounding)
        << angle;
}

TEST(RotationVector, AngularVelocityIsTheJacobianTimesTheRate) {
  for (const double angle : kAngles) {
    const Vector3 phi = angle * kAxis;
    const RotationVector<double> turn(phi);
    const Matrix3 R_rate = rate_of(RotationVector<Dual>(moving(phi, kRate)).R);
    EXPECT_LT((R_rate - skew(turn.J * kRate) * turn.R).norm(), 1e-13) << angle;
  }
}

TEST(RotationVector, BiasIsTheAngularAccelerationAtAConstantRate) {
  for (const double angle : kAngles) {
    const Vector3 phi = angle * kAxis;
    const Vector3 bias = rate_of(RotationVector<Dual>(moving(phi, kRate)).J) * kRate;
    EXPECT_LT((rotation_vector_bias<double>(phi, kRate) - bias).norm(), 1e-13) << angle;
  }
}

TEST(RotationVector, JacobianIsTheInverseOfTheRateMatrix) {
  for (const double angle : kAngles) {
    const Vector3 phi = angle * kAxis;
    const RotationVector<double> turn(phi);
    // which takes the angular velocity in the axes that turn
    const Matrix3 product = rotation_vector_rate_matrix<double>(phi) * turn.R.transpose() * turn.J;
    EXPECT_LT((product - Matrix3::Identity()).norm(), 1e-12) << angle;
  }
}

}  // namespace
}  // namespace wishbone
