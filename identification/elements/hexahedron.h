#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Linear isotropic material.
struct IsotropicMaterial {
  double youngs_modulus = 0;  ///< E > 0 [Pa]
  double poissons_ratio = 0;  ///< -1 < nu < 1/2 [-]
  double density = 0;         ///< rho > 0 [kg/m3]

  /// Stress = D strain, strains (xx, yy, zz, xy, yz, zx) with engineering shears gamma = 2 epsilon [Pa].
  Eigen::Matrix<double, 6, 6> elasticity() const;
  /// Throws InputError naming the property out of its range.
  void validate() const;
};

/// Eight-node hexahedron with trilinear displacements and mean dilatation (B-bar), integrated with 2 x 2 x 2
/// Gauss points: the volumetric part of the strain operator is replaced by its mean over the element, which
/// keeps nearly incompressible material from locking,
///     B-bar = B + 1/3 (1 1 1 0 0 0)^T (b_mean - b),   b = (1 1 1 0 0 0) B,   b_mean = 1/V int b dV.
/// It passes the patch test. Corners 1-4 run round the face zeta = -1, counterclockwise seen from the
/// opposite face; corners 5-8 lie over them on zeta = +1. Displacements are stacked corner by corner in x, y,
/// z (24). Source: T. J. R. Hughes, The Finite Element Method, 1987, section 4.5.2.
class Hexahedron {
 public:
  using Corners = Eigen::Matrix<double, 3, 8>;
  using StrainOperator = Eigen::Matrix<double, 6, 24>;
  using Stiffness = Eigen::Matrix<double, 24, 24>;
  using Displacement = Eigen::Matrix<double, 24, 1>;

  /// `corners` [m] as columns; `id` is the element's name in error messages.
  /// Throws InputError if the Jacobian determinant is not positive at every Gauss point.
  Hexahedron(const Corners& corners, int id);

  /// [m3], by the quadrature (exact for trilinear geometry).
  double volume() const { return volume_; }

  /// B-bar (6 x 24) at xi = (xi, eta, zeta) in [-1, 1]^3: strain = B-bar displacement, order as in
  /// IsotropicMaterial.
  StrainOperator strain_operator(const Vector3& xi) const;

  /// K = int B-bar^T D B-bar dV [N/m], with D the material's elasticity.
  Stiffness stiffness(const Matrix6& elasticity) const;

  /// What the stress sigma of a small displacement u, sigma = D B-bar u, adds to the stiffness against each of the three
  /// translations of the corners (8 x 8), K_AB = int (dN_A/dx)^T sigma (dN_B/dx) dV [N/m]: the stress stiffness of the
  /// von Karman strains. Source: T. Belytschko, W. K. Liu, B. Moran, Nonlinear Finite Elements, 2000, section 6.4.
  Eigen::Matrix<double, 8, 8> stress_stiffness(const Matrix6& elasticity, const Displacement& u) const;

 private:
  using Gradients = Eigen::Matrix<double, 3, 8>;

  /// dN/dx (3 x 8) and det dx/dxi at xi.
  Gradients shape_gradients(const Vector3& xi, double* jacobian_determinant) const;

  Corners corners_;
  double volume_ = 0;
  Gradients mean_gradients_ = Gradients::Zero();  ///< 1/V int dN/dx dV
};

}  // namespace wishbone
