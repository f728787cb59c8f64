#pragma once

#include "core/spatial.h"
#include "core/stumpff.h"

namespace wishbone {

/// Rotation by a rotation vector phi (axis times angle [rad]) and what turns rates of phi into angular velocities. With
/// J the left Jacobian of the rotation group and c_n(|phi|^2) the functions of core/stumpff.h
///     R = exp(phi~) = 1 + c_1 phi~ + c_2 phi~^2,      J = 1 + c_2 phi~ + c_3 phi~^2,
///     R' = w~ R with w = J(phi) phi'.
/// Exact at any angle; J loses its rank at |phi| = 2 pi.
template <class T>
struct RotationVector {
  Matrix3T<T> R, J;

  explicit RotationVector(const Vector3T<T>& phi) {
    const Stumpff<T> c(phi.squaredNorm());
    const Matrix3T<T> S = skew(phi), SS = S * S;
    R = Matrix3T<T>::Identity() + S * c.c1 + SS * c.c2;
    J = Matrix3T<T>::Identity() + S * c.c2 + SS * c.c3;
  }
};

/// J'(phi) phi', the angular acceleration at phi'' = 0: with s = |phi|^2, s' = 2 phi.phi' and
/// phi x (phi x phi') = phi (phi.phi') - s phi'
///     c_2' s' phi x phi' + c_3' s' (phi (phi.phi') - s phi') + c_3 (phi |phi'|^2 - phi' (phi.phi')).
template <class T>
Vector3T<T> rotation_vector_bias(const Vector3T<T>& phi, const Vector3T<T>& phi_rate) {
  const T s = phi.squaredNorm(), dot = phi.dot(phi_rate), s_rate = 2.0 * dot;
  const Stumpff<T> c(s);
  return phi.cross(phi_rate) * (c.c2_rate() * s_rate) + (phi * dot - phi_rate * s) * (c.c3_rate() * s_rate) +
         (phi * phi_rate.squaredNorm() - phi_rate * dot) * c.c3;
}

}  // namespace wishbone
