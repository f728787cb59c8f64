#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Damping proportional to mass and stiffness of the nodes [Rayleigh 1877], C = alpha M + beta K.
///
/// M here is the mass against the deflections: damping forces act on the rates of z alone, in mean axes, and rigid
/// motion is not damped,
///     C = alpha (M - M Psi_0 Psi_0^T M) + beta K.
/// So in shapes with mean axes C_z = alpha 1 + beta K_z, and of every set with Psi^T M Psi = 1 and Psi^T K Psi =
/// diag(omega^2), normal modes or not, each mode has the ratio
///     zeta_j = alpha / (2 omega_j) + beta omega_j / 2.
struct RayleighDamping {
  double mass = 0;       ///< alpha >= 0 [1/s]
  double stiffness = 0;  ///< beta >= 0 [s]

  /// zeta of modes with the angular frequencies omega > 0 [rad/s].
  VectorX ratios(const VectorX& omega) const {
    return (0.5 * mass * omega.cwiseInverse()) + (0.5 * stiffness * omega);
  }
};

}  // namespace wishbone
