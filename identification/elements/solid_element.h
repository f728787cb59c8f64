#pragma once

#include "identification/elements/element_geometry.h"

namespace wishbone {

/// A solid element of one material. Displacements are stacked node by node in x, y, z (3n); stresses follow from the strains
///     epsilon = B u,   B of the shape functions' gradients, the types of 8 nodes excepted:
///
/// incompatible_modes: inner motions P_k = 1 - xi_k^2 along each axis, which neighbours do not share, let the element bend.
/// They are those of least energy,
///     epsilon = B u + G alpha,   int G^T D (B u + G alpha) dV = 0,   grad P_k = (det J_0 / det J) J_0^-T dP_k/dxi,
/// with J = dx/dxi and J_0 its value at the centre, by which int G dV = 0, so that uniform strains move nothing inside and the
/// patch test is passed. Source: E. L. Wilson, R. L. Taylor, W. P. Doherty, J. Ghaboussi, Incompatible displacement models, in
/// Numerical and Computer Methods in Structural Mechanics, 1973; R. L. Taylor, P. J. Beresford, E. L. Wilson, Int. J. Numer.
/// Meth. Eng. 10 (1976) 1211-1219.
///
/// mean_dilatation: the volumetric part of B is replaced by its mean over the element (B-bar),
///     B-bar = B + 1/3 (1 1 1 0 0 0)^T (b_mean - b),   b = (1 1 1 0 0 0) B,   b_mean = 1/V int b dV,
/// which keeps nearly incompressible material from locking; in bending it stays too stiff where it is long and, one across, too
/// soft where it is short. Source: T. J. R. Hughes, The Finite Element Method, 1987, section 4.5.2.
class SolidElement {
 public:
  using StrainOperator = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 3 * kMostElementNodes>;

  /// @throws InputError as ElementGeometry
  SolidElement(ElementType type, const Matrix3X& nodes, const Matrix6& elasticity, int id);

  const ElementGeometry& geometry() const { return geometry_; }

  /// Strain = operator * displacement (6 x 3n), order as in IsotropicMaterial.
  StrainOperator strain_operator(const Vector3& xi) const;

  /// K = int B^T D B dV (3n x 3n) [N/m].
  MatrixX stiffness() const;

  /// int u_a . u_b dV of the displacements inside, u = sum N_A u_A + sum P_k alpha_k (3n x 3n) [m3].
  MatrixX displacement_products() const;

  /// What the stress sigma of a small displacement u, sigma = D B u, adds to the stiffness against each of the three
  /// translations of the nodes (n x n), K_AB = int (dN_A/dx)^T sigma (dN_B/dx) dV [N/m]: the stress stiffness of the
  /// von Karman strains. Source: T. Belytschko, W. K. Liu, B. Moran, Nonlinear Finite Elements, 2000, section 6.4.
  MatrixX stress_stiffness(const VectorX& u) const;

 private:
  using InnerOperator = Eigen::Matrix<double, 6, 9>;

  StrainOperator compatible_operator(const AtElementNodes<3>& gradients) const;
  InnerOperator inner_operator(const Vector3& xi, double determinant) const;
  void find_mean_gradients();
  void find_inner_motion();

  ElementType type_;
  ElementGeometry geometry_;
  Matrix6 elasticity_;
  AtElementNodes<3> mean_gradients_;           ///< 1/V int dN/dx dV, of mean_dilatation
  Eigen::Matrix<double, 9, 24> inner_motion_;  ///< alpha = inner_motion u, of incompatible_modes
};

}  // namespace wishbone
