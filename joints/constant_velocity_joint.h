#pragma once

#include <tuple>

#include "core/rotation_vector.h"
#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Homokinetic joint of two shafts along `axis` of F and of M: the relative rotation has its rotation vector
///     phi = q1 first + q2 second
/// in the plane normal to the shaft of F, which is that of M as well, so that both shafts spin alike at any angle: in
/// triads with z along the shafts x_F . y_M = y_F . x_M. q in rad, |q| < pi; v = q'. With J of core/rotation_vector.h
///     R_FM = exp(phi~),   w_FM = J(phi) phi'.
struct ConstantVelocityJoint : AdditiveCoordinates<2> {
  static constexpr const char* kKind = "constant_velocity";
  static constexpr bool kRotates = true, kTranslates = false, kHasDrift = true;

  Vector3 first_F = Vector3::UnitX();  ///< unit vectors normal to the shaft and to each other
  Vector3 second_F = Vector3::UnitY();

  ConstantVelocityJoint() = default;
  /// Shafts along a unit vector; directions normal to it are chosen.
  explicit ConstantVelocityJoint(const Vector3& axis) { std::tie(first_F, second_F) = perpendiculars(axis); }
  ConstantVelocityJoint(const Vector3& first, const Vector3& second) : first_F(first), second_F(second) {}

  /// Direction of the shaft of F.
  Vector3 axis_F() const { return first_F.cross(second_F); }

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    const RotationVector<T> turn(in_plane(q));
    out.X_FM.R = turn.R;
    out.H.template block<3, 1>(0, 0) = turn.J * first_F.cast<T>();
    out.H.template block<3, 1>(0, 1) = turn.J * second_F.cast<T>();
  }

  /// H' v = J'(phi) phi'.
  template <class T>
  void calc_drift(double /*t*/, const T* q, const T* v, Vector6T<T>& V_drift, Vector6T<T>& A_drift) const {
    V_drift.setZero();
    A_drift << rotation_vector_bias<T>(in_plane(q), in_plane(v)), Vector3T<T>::Zero();
  }

  /// The inverse turns by -phi: both directions change sign, so that the coordinates keep theirs, and the shaft's
  /// direction, first x second, stays.
  ConstantVelocityJoint reversed() const { return {-first_F, -second_F}; }

 private:
  template <class T>
  Vector3T<T> in_plane(const T* q) const {
    return first_F.cast<T>() * q[0] + second_F.cast<T>() * q[1];
  }
};

}  // namespace wishbone
