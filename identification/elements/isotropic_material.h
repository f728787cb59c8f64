#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Linear isotropic material.
struct IsotropicMaterial {
  double youngs_modulus = 0;  ///< E > 0 [Pa]
  double poissons_ratio = 0;  ///< -1 < nu < 1/2 [-]
  double density = 0;         ///< rho > 0 [kg/m3]

  /// Stress = D strain, strains (xx, yy, zz, xy, yz, zx) with engineering shears gamma = 2 epsilon [Pa].
  Matrix6 elasticity() const;
  /// Throws InputError naming the property out of its range.
  void validate() const;
};

}  // namespace wishbone
