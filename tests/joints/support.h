#pragma once

#include <random>
#include <string>
#include <vector>

#include "core/dual.h"
#include "joints/every_joint.h"

namespace wishbone::testing {

/// Reproducible random numbers.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  Vector3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  VectorX numbers(int n, double size) {
    return VectorX::NullaryExpr(n, [&] { return uniform(-size, size); });
  }
  Vector3 direction() { return vector(1).normalized(); }
  Matrix3 rotation() { return rotation_about(direction(), uniform(-3, 3)); }

 private:
  std::mt19937 engine_;
};

/// a + b e: the number whose derivative along the first direction is b.
inline Dual dual(double a, double b) {
  Dual x(a);
  x.d[0] = b;
  return x;
}
template <class A, class B>
auto dual(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.binaryExpr(b, [](double x, double x_rate) { return dual(x, x_rate); }).eval();
}

/// Value and derivative along the first direction of an array of dual numbers.
template <class D>
auto values(const Eigen::MatrixBase<D>& x) {
  return x.unaryExpr([](const Dual& a) { return a.value; }).eval();
}
template <class D>
auto rates(const Eigen::MatrixBase<D>& x) {
  return x.unaryExpr([](const Dual& a) { return a.d[0]; }).eval();
}

/// The vector of a skew matrix.
inline Vector3 unskew(const Matrix3& S) {
  return {S(2, 1), S(0, 2), S(1, 0)};
}

/// Every tree joint with random axes.
inline std::vector<TreeJoint> all_tree_joints(Random& random) {
  const Vector3 axis = random.direction();
  return every_tree_joint(axis, random.direction());
}

/// Coordinates anywhere that the joint can reach, up to `size` rad or m from neutral in each direction.
template <class Joint>
VectorX random_coordinates(const Joint& joint, Random& random, double size = 1.5) {
  VectorX q(Joint::kNq);
  joint.set_neutral(q.data());
  const VectorX d = random.numbers(Joint::kNv, size);
  joint.retract(d.data(), q.data());
  return q;
}

/// Coordinates that move with the speeds v: q + N(q) v e.
template <class Joint>
VectorXT<Dual> moving(const Joint& joint, const VectorX& q, const VectorX& v) {
  VectorX q_rate(Joint::kNq);
  joint.calc_q_rate(q.data(), v.data(), q_rate.data());
  return dual(q, q_rate);
}

template <class Joint, class T>
AcrossJoint<Joint::kNv, T> across(const Joint& joint, double t, const VectorXT<T>& q) {
  AcrossJoint<Joint::kNv, T> out;
  joint.calc_across(t, q.data(), out);
  return out;
}

struct Drift {
  Vector6 V = Vector6::Zero(), A = Vector6::Zero();
};
template <class Joint>
Drift drift(const Joint& joint, double t, const VectorX& q, const VectorX& v) {
  Drift d;
  if constexpr (Joint::kHasDrift) joint.calc_drift(t, q.data(), v.data(), d.V, d.A);
  return d;
}

}  // namespace wishbone::testing
