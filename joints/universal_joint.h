#pragma once

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Cardan joint: a cross turns by q1 [rad] about an axis fixed in F, and M by q2 about the cross's other, perpendicular
/// arm: R_FM = R(first, q1) R(second, q2); v = q'. The second arm, R1 second, moves as seen from F:
///     w_FM = q1' first + q2' R1 second,   H' v = q1' q2' first x (R1 second).
/// Its two axes are independent in every pose.
struct UniversalJoint : AdditiveCoordinates<2> {
  static constexpr const char* kKind = "universal";
  static constexpr bool kRotates = true, kTranslates = false, kHasDrift = true;

  Vector3 first_F = Vector3::UnitX();   ///< unit vector, fixed in F
  Vector3 second_F = Vector3::UnitY();  ///< unit vector normal to it, fixed in M; at q1 = 0

  UniversalJoint() = default;
  UniversalJoint(const Vector3& first, const Vector3& second) : first_F(first), second_F(second) {}

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    const Matrix3T<T> R1 = rotation_about(first_F, q[0]);
    out.X_FM.R = R1 * rotation_about(second_F, q[1]);
    out.H.template block<3, 1>(0, 0) = first_F.cast<T>();
    out.H.template block<3, 1>(0, 1) = R1 * second_F.cast<T>();
  }
  template <class T>
  void calc_drift(double /*t*/, const T* q, const T* v, Vector6T<T>& V_drift, Vector6T<T>& A_drift) const {
    const Vector3T<T> first = first_F.cast<T>();
    const Vector3T<T> arm = rotation_about(first_F, q[0]) * second_F.cast<T>();
    V_drift.setZero();
    A_drift << first.cross(arm) * (v[0] * v[1]), Vector3T<T>::Zero();
  }
};

}  // namespace wishbone
