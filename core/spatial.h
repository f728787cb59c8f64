#pragma once

#include <Eigen/Dense>

/// Spatial algebra in one convention: every spatial vector is referred to a body origin Bo, has **world axes**, and
/// stacks the angular part above the linear one:
///   velocity V_WB = (w_WB, v_WBo), acceleration A_WB = (alpha_WB, a_WBo), wrench F_Bo = (t_Bo, f).
/// World axes keep every shift between bodies a matter of one position vector (no rotation); the moving origin keeps
/// full precision however far the mechanism travels. Notation: docs/notation.md.
namespace wishbone {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using VectorX = Eigen::VectorXd;
using MatrixX = Eigen::MatrixXd;
using Matrix3X = Eigen::Matrix3Xd;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using Quaternion = Eigen::Quaterniond;

/// Pose X_AB: rotation R_AB (B axes to A axes) and position p_AB of Bo from Ao, in A.
struct Pose {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();

  /// X_AC = X_AB X_BC.
  Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, p + R * X_BC.p}; }
  /// Position p_AQ of a point given by p_BQ.
  Vector3 operator*(const Vector3& p_BQ) const { return p + R * p_BQ; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// The matrix a~ with a~ b = a x b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

inline auto angular(Vector6& V) {
  return V.head<3>();
}
inline auto angular(const Vector6& V) {
  return V.head<3>();
}
inline auto linear(Vector6& V) {
  return V.tail<3>();
}
inline auto linear(const Vector6& V) {
  return V.tail<3>();
}

inline Vector6 spatial(const Vector3& angular_part, const Vector3& linear_part) {
  Vector6 V;
  V << angular_part, linear_part;
  return V;
}

/// Rigid shift of a velocity from Po to Bo: (w, v_Po + w x p_PB).
inline Vector6 shift_velocity(const Vector6& V_P, const Vector3& p_PB) {
  return spatial(angular(V_P), linear(V_P) + Vector3(angular(V_P)).cross(p_PB));
}

/// The same wrench taken about Po instead of Bo: (t_Bo + p_PB x f, f).
inline Vector6 shift_wrench(const Vector6& F_B, const Vector3& p_PB) {
  return spatial(angular(F_B) + p_PB.cross(Vector3(linear(F_B))), linear(F_B));
}

/// Spatial inertia about Po of a (possibly articulated) inertia given about Bo:
/// X^T I X with X = [1 0; -p~ 1] the rigid shift from Po to Bo.
inline Matrix6 shift_inertia(const Matrix6& I_B, const Vector3& p_PB) {
  const Matrix3 p = skew(p_PB);
  Matrix6 I_P;
  const Matrix3 m = I_B.bottomRightCorner<3, 3>();
  const Matrix3 h = I_B.topRightCorner<3, 3>() + p * m;  // upper right block about Po
  I_P.topRightCorner<3, 3>() = h;
  I_P.bottomLeftCorner<3, 3>() = h.transpose();
  I_P.bottomRightCorner<3, 3>() = m;
  I_P.topLeftCorner<3, 3>() = I_B.topLeftCorner<3, 3>() + p * I_B.bottomLeftCorner<3, 3>() - h * p;
  return I_P;
}

/// Unit quaternion (w x y z) of a rotation vector (axis times angle), accurate down to angle zero.
Quaternion quaternion_from_rotation_vector(const Vector3& phi);

/// Rotation matrix of a quaternion given as (w, x, y, z), which need not have unit length.
Matrix3 rotation_from_quaternion(const Eigen::Ref<const Eigen::Vector4d>& q_wxyz);

/// d/dt (w, x, y, z) of a quaternion R_FM whose frame M turns with w_FM_M (components in M):
/// q' = 1/2 q o (0, w).
Eigen::Vector4d quaternion_rate(const Eigen::Ref<const Eigen::Vector4d>& q_wxyz, const Vector3& w_FM_M);

/// Two unit vectors that complete `axis` (unit) to a right-handed triad (axis, first, second).
std::pair<Vector3, Vector3> perpendiculars(const Vector3& axis);

}  // namespace wishbone
