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
struct WheelContact {
  Vector3 P0;  ///< road point below the wheel centre [m]
  Vector3 P;   ///< contact point, in the wheel plane and in the tangent plane of the road [m]
  Vector3 ux, uy, uz;
  double upright = 0;        ///< |us x uz| = cos(camber); the geometry is lost at 0, when the wheel lies flat
  double loaded_radius = 0;  ///< rho [m]
  double deflection = 0;     ///< delta [m]; negative in the air
  double deflection_rate = 0;  ///< delta' = -v_P.uz [m/s]
  double camber = 0;  ///< gamma = -asin(us.uz) [rad], positive when the top of the wheel leans toward +uy
  double vx = 0;      ///< v_P.ux [m/s]
  double vy = 0;      ///< v_P.uy [m/s]
  double spin = 0;    ///< Omega = w.us [rad/s]
  double v_cir = 0;   ///< circumferential velocity of the tread (R1 - delta/3) Omega [m/s]
};

/// @param wheel marker at the wheel centre whose y axis is the spin axis, pointing left; its w_WM includes
/// the spin
/// @param segment active road segment
WheelContact wheel_contact(const MarkerState& wheel, double radius, const Road& road, int segment);

}  // namespace wishbone
