#pragma once

#include <Eigen/Dense>
#include <cmath>

/// Spatial algebra in one convention: every spatial vector is referred to a body origin Bo, has **world axes**, and
/// stacks the angular part above the linear one:
///   velocity V_WB = (w_WB, v_WBo), acceleration A_WB = (alpha_WB, a_WBo), wrench F_Bo = (t_Bo, f).
/// World axes keep every shift between bodies a matter of one position vector (no rotation); the moving origin keeps
/// full precision however far the mechanism travels. Notation: docs/notation.md.
namespace wishbone {

/// What is differentiated is written once, for any scalar T: `double`, `Dual` (core/dual.h), `std::complex<double>`.
template <class T>
using Vector3T = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3T = Eigen::Matrix<T, 3, 3>;
template <class T>
using Vector6T = Eigen::Matrix<T, 6, 1>;
template <class T>
using Matrix6T = Eigen::Matrix<T, 6, 6>;
template <class T>
using VectorXT = Eigen::Matrix<T, Eigen::Dynamic, 1>;
template <class T>
using Matrix3XT = Eigen::Matrix<T, 3, Eigen::Dynamic>;
template <class T>
using Matrix6XT = Eigen::Matrix<T, 6, Eigen::Dynamic>;

using Vector3 = Vector3T<double>;
using Matrix3 = Matrix3T<double>;
using Vector6 = Vector6T<double>;
using Matrix6 = Matrix6T<double>;
using VectorX = VectorXT<double>;
using MatrixX = Eigen::MatrixXd;
using Matrix3X = Matrix3XT<double>;
using Matrix6X = Matrix6XT<double>;
using Quaternion = Eigen::Quaterniond;

/// Pose X_AB: rotation R_AB (B axes to A axes) and position p_AB of Bo from Ao, in A.
template <class T>
struct PoseT {
  Matrix3T<T> R = Matrix3T<T>::Identity();
  Vector3T<T> p = Vector3T<T>::Zero();

  /// X_AC = X_AB X_BC.
  template <class U>
  PoseT operator*(const PoseT<U>& X_BC) const {
    return {R * X_BC.R, p + R * X_BC.p};
  }
  /// Position p_AQ of a point given by p_BQ.
  Vector3T<T> operator*(const Vector3& p_BQ) const { return p + R * p_BQ; }
  PoseT inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};
using Pose = PoseT<double>;

/// The matrix a~ with a~ b = a x b.
template <class D>
Matrix3T<typename D::Scalar> skew(const Eigen::MatrixBase<D>& a) {
  Matrix3T<typename D::Scalar> S;
  S << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return S;
}

template <class D>
auto angular(Eigen::MatrixBase<D>& V) {
  return V.template head<3>();
}
template <class D>
auto angular(const Eigen::MatrixBase<D>& V) {
  return V.template head<3>();
}
template <class D>
auto linear(Eigen::MatrixBase<D>& V) {
  return V.template tail<3>();
}
template <class D>
auto linear(const Eigen::MatrixBase<D>& V) {
  return V.template tail<3>();
}

template <class A, class L>
Vector6T<typename A::Scalar> spatial(const Eigen::MatrixBase<A>& angular_part,
                                     const Eigen::MatrixBase<L>& linear_part) {
  Vector6T<typename A::Scalar> V;
  V << angular_part, linear_part;
  return V;
}

inline Vector6 spatial(const Vector3& angular_part, const Vector3& linear_part) {
  return spatial<Vector3, Vector3>(angular_part, linear_part);
}

/// Rigid shift of a velocity from Po to Bo: (w, v_Po + w x p_PB).
template <class T>
Vector6T<T> shift_velocity(const Vector6T<T>& V_P, const Vector3T<T>& p_PB) {
  return spatial(angular(V_P), linear(V_P) + angular(V_P).cross(p_PB));
}

/// The same wrench taken about Po instead of Bo: (t_Bo + p_PB x f, f).
template <class T>
Vector6T<T> shift_wrench(const Vector6T<T>& F_B, const Vector3T<T>& p_PB) {
  return spatial(angular(F_B) + p_PB.cross(linear(F_B)), linear(F_B));
}

inline Vector6 shift_velocity(const Vector6& V_P, const Vector3& p_PB) {
  return shift_velocity<double>(V_P, p_PB);
}
inline Vector6 shift_wrench(const Vector6& F_B, const Vector3& p_PB) {
  return shift_wrench<double>(F_B, p_PB);
}

/// R J R^T of a symmetric J.
inline Matrix3 rotate_inertia(const Matrix3& R, const Matrix3& J) {
  const Matrix3 RJ = R * J;
  Matrix3 result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      result(i, j) = result(j, i) = RJ(i, 0) * R(j, 0) + RJ(i, 1) * R(j, 1) + RJ(i, 2) * R(j, 2);
  return result;
}

/// Adds a (possibly articulated) spatial inertia I_B about Bo to one about Po:
/// I_P += X^T I_B X with X = [1 0; -p~ 1] the rigid shift from Po to Bo. With blocks [J B; B^T M] about Bo those about Po are
/// [J + p~ B^T - B_P p~, B_P; B_P^T, M], B_P = B + p~ M.
inline void add_shifted_inertia(const Matrix6& I_B, const Vector3& p_PB, Matrix6& I_P) {
  Matrix3 B_P, J_P;
  for (int j = 0; j < 3; ++j) {
    B_P.col(j) = I_B.block<3, 1>(0, 3 + j) + p_PB.cross(I_B.block<3, 1>(3, 3 + j));
    J_P.col(j) = I_B.block<3, 1>(0, j) + p_PB.cross(I_B.block<3, 1>(3, j));
  }
  J_P.col(0) += B_P.col(2) * p_PB.y() - B_P.col(1) * p_PB.z();
  J_P.col(1) += B_P.col(0) * p_PB.z() - B_P.col(2) * p_PB.x();
  J_P.col(2) += B_P.col(1) * p_PB.x() - B_P.col(0) * p_PB.y();
  I_P.topLeftCorner<3, 3>() += J_P;
  I_P.topRightCorner<3, 3>() += B_P;
  I_P.bottomLeftCorner<3, 3>() += B_P.transpose();
  I_P.bottomRightCorner<3, 3>() += I_B.bottomRightCorner<3, 3>();
}

/// Rotation by `angle` about the unit vector `axis`: c 1 + s axis~ + (1 - c) axis axis^T.
template <class T>
Matrix3T<T> rotation_about(const Vector3& axis, const T& angle) {
  using std::cos;
  using std::sin;
  const T s = sin(angle), c = cos(angle);
  const Vector3T<T> sa = axis.cast<T>() * s;
  const Vector3T<T> ca = axis.cast<T>() * (1.0 - c);
  Matrix3T<T> R;
  for (int j = 0; j < 3; ++j) R.col(j) = ca * T(axis[j]);
  R.diagonal().array() += c;
  R(0, 1) -= sa.z();
  R(1, 0) += sa.z();
  R(0, 2) += sa.y();
  R(2, 0) -= sa.y();
  R(1, 2) -= sa.x();
  R(2, 1) += sa.x();
  return R;
}

/// Unit quaternion (w x y z) of a rotation vector (axis times angle), accurate down to angle zero.
Quaternion quaternion_from_rotation_vector(const Vector3& phi);

/// Rotation vector of a unit quaternion, its angle in 0 ... pi; the inverse of the above.
Vector3 rotation_vector_from_quaternion(const Quaternion& Q);

/// Rotation matrix of a quaternion given as (w, x, y, z), which need not have unit length.
template <class T>
Matrix3T<T> rotation_from_quaternion(const T* q_wxyz) {
  const Eigen::Map<const Eigen::Matrix<T, 4, 1>> q(q_wxyz);
  const T w = q[0], x = q[1], y = q[2], z = q[3];
  const T s = 2.0 / q.squaredNorm();
  Matrix3T<T> R;
  R << 1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y);
  return R;
}

inline Matrix3 rotation_from_quaternion(const Eigen::Vector4d& q_wxyz) {
  return rotation_from_quaternion<double>(q_wxyz.data());
}

/// d/dt (w, x, y, z) of a quaternion R_FM whose frame M turns with w_FM_M (components in M):
/// q' = 1/2 q o (0, w).
template <class T>
Eigen::Matrix<T, 4, 1> quaternion_rate(const T* q_wxyz, const Vector3T<T>& w_FM_M) {
  const T w = 0.5 * q_wxyz[0];
  const Vector3T<T> u = 0.5 * Eigen::Map<const Vector3T<T>>(q_wxyz + 1);
  Eigen::Matrix<T, 4, 1> rate;
  rate << -u.dot(w_FM_M), w * w_FM_M + u.cross(w_FM_M);
  return rate;
}

inline Eigen::Vector4d quaternion_rate(const Eigen::Vector4d& q_wxyz, const Vector3& w_FM_M) {
  return quaternion_rate<double>(q_wxyz.data(), w_FM_M);
}

/// The matrix that turns an angular velocity w_FM_M into the rate of the rotation vector phi of R_FM = exp(phi~):
///   phi' = (1 + phi~/2 + c phi~^2) w,   c = (1 - (|phi|/2) cot(|phi|/2))/|phi|^2,   |phi| < 2 pi.
template <class T>
Matrix3T<T> rotation_vector_rate_matrix(const Vector3T<T>& phi) {
  using std::sqrt;
  using std::tan;
  const T square = phi.squaredNorm();
  T c = 1.0 / 12 + square / 720 + square * square / 30240;  // exact to double precision below 0.01
  if (square > 1e-4) {
    const T half = 0.5 * sqrt(square);
    c = (1.0 - half / tan(half)) / square;
  }
  const Matrix3T<T> S = skew(phi);
  Matrix3T<T> rate = 0.5 * S + c * (S * S);
  rate.diagonal().array() += T(1);
  return rate;
}

/// Two unit vectors that complete `axis` (unit) to a right-handed triad (axis, first, second).
std::pair<Vector3, Vector3> perpendiculars(const Vector3& axis);

}  // namespace wishbone
