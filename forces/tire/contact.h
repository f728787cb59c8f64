#pragma once

#include "bodies/marker.h"
#include "core/spatial.h"
#include "forces/road/road.h"

namespace wishbone {

/// One-point contact of a disc of radius R1 with the road, world components.
///
/// The road is replaced by its tangent plane at P0, the point straight below the wheel centre C; us is the
/// spin axis:
///     ux = us x uz normalised (heading),   uy = uz x ux (left),
///     e = -(uz - (uz.us) us) normalised (down in the wheel plane),
///     d = (C - P0).uz,   rho = d/(-e.uz),   P = C + rho e,   delta = R1 - rho (in contact when positive).
/// Velocities are those of the point of the *non-spinning* wheel carrier at P:
///     v_P = v_C + (w - (w.us) us) x (P - C).
template <class T>
struct WheelContactT {
  Vector3T<T> P0;  ///< road point below the wheel centre [m]
  Vector3T<T> P;   ///< contact point, in the wheel plane and in the tangent plane of the road [m]
  Vector3T<T> ux, uy, uz;
  T upright = T(0);          ///< |us x uz| = cos(camber); the geometry is lost at 0, when the wheel lies flat
  T loaded_radius = T(0);    ///< rho [m]
  T deflection = T(0);       ///< delta [m]; negative in the air
  T deflection_rate = T(0);  ///< delta' = -v_P.uz [m/s]
  T camber = T(0);  ///< gamma = -asin(us.uz) [rad], positive when the top of the wheel leans toward +uy
  T vx = T(0);      ///< v_P.ux [m/s]
  T vy = T(0);      ///< v_P.uy [m/s]
  T spin = T(0);    ///< Omega = w.us [rad/s]
  T v_cir = T(0);   ///< circumferential velocity of the tread (R1 - delta/3) Omega [m/s]
};
using WheelContact = WheelContactT<double>;

/// @param wheel marker at the wheel centre whose y axis is the spin axis, pointing left; its w_WM includes
/// the spin
/// @param segment active road segment
template <class T>
WheelContactT<T> wheel_contact(const MarkerStateT<T>& wheel, double radius, const Road& road, int segment);

}  // namespace wishbone
