#include "identification/elements/isotropic_material.h"

#include <fmt/format.h>

#include "core/error.h"

namespace wishbone {

void IsotropicMaterial::validate() const {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError({"material", what, fmt::format("{:g}", value), "give it in SI units"});
  };
  require(youngs_modulus > 0, "Young's modulus must be positive", youngs_modulus);
  require(poissons_ratio > -1 && poissons_ratio < 0.5, "Poisson's ratio must lie between -1 and 1/2",
          poissons_ratio);
  require(density > 0, "the density must be positive", density);
}

Matrix6 IsotropicMaterial::elasticity() const {
  const double mu = youngs_modulus / (2 * (1 + poissons_ratio));
  const double lambda = 2 * mu * poissons_ratio / (1 - 2 * poissons_ratio);
  Matrix6 D = Matrix6::Zero();
  D.topLeftCorner<3, 3>() = lambda * Matrix3::Ones() + 2 * mu * Matrix3::Identity();
  D.bottomRightCorner<3, 3>() = mu * Matrix3::Identity();
  return D;
}

}  // namespace wishbone
