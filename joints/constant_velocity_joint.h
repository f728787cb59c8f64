#pragma once

#include <tuple>

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"
#include "joints/stumpff.h"

namespace wishbone {

/// Homokinetic joint of two shafts along `axis` of F and of M: the relative rotation has its rotation vector
///     phi = q1 first + q2 second
/// in the plane normal to the shaft of F, which is that of M as well, so that both shafts spin alike at any angle: in
/// triads with z along the shafts x_F . y_M = y_F . x_M. q in rad, |q| < pi; v = q'. With J the left Jacobian of the
/// rotation group and c_n(|phi|^2) the functions of joints/stumpff.h
///     R_FM = 1 + c_1 phi~ + c_2 phi~^2,
///     w_FM = J(phi) phi' = phi' + c_2 phi x phi' + c_3 phi x (phi x phi').
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
    const Vector3T<T> phi = in_plane(q);
    const Stumpff<T> c(phi.squaredNorm());
    const Matrix3T<T> S = skew(phi), SS = S * S;
    out.X_FM.R = Matrix3T<T>::Identity() + S * c.c1 + SS * c.c2;
    const Matrix3T<T> J = Matrix3T<T>::Identity() + S * c.c2 + SS * c.c3;
    out.H.template block<3, 1>(0, 0) = J * first_F.cast<T>();
    out.H.template block<3, 1>(0, 1) = J * second_F.cast<T>();
  }

  /// H' v = J' phi': with s = |phi|^2, s' = 2 phi.phi' and phi x (phi x phi') = phi (phi.phi') - s phi'
  ///     c_2' s' phi x phi' + c_3' s' (phi (phi.phi') - s phi') + c_3 (phi |phi'|^2 - phi' (phi.phi')).
  template <class T>
  void calc_drift(double /*t*/, const T* q, const T* v, Vector6T<T>& V_drift, Vector6T<T>& A_drift) const {
    const Vector3T<T> phi = in_plane(q), phi_rate = in_plane(v);
    const T s = phi.squaredNorm(), dot = phi.dot(phi_rate), s_rate = 2.0 * dot;
    const Stumpff<T> c(s);
    const Vector3T<T> alpha = phi.cross(phi_rate) * (c.c2_rate() * s_rate) +
                              (phi * dot - phi_rate * s) * (c.c3_rate() * s_rate) +
                              (phi * phi_rate.squaredNorm() - phi_rate * dot) * c.c3;
    V_drift.setZero();
    A_drift << alpha, Vector3T<T>::Zero();
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
