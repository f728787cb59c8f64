#pragma once

#include "identification/elements/reference_element.h"

namespace wishbone {

/// Where an element lies: x = sum N_a x_a.
class ElementGeometry {
 public:
  /// `nodes` [m] as columns; `id` is the element's name in error messages.
  /// @throws InputError if the Jacobian determinant is not positive at every quadrature point (inside out), or a middle node is
  ///   not near the middle of its edge (nodes in another program's order)
  ElementGeometry(ElementType type, const Matrix3X& nodes, int id);

  const ReferenceElement& reference() const { return *reference_; }
  int node_count() const { return reference_->nodes; }
  double volume() const { return volume_; }  ///< by the quadrature [m3]

  /// dx/dxi (row: x, column: xi) [m].
  Matrix3 jacobian(const Vector3& xi) const;
  /// dN/dx (3 x nodes) [1/m] and det dx/dxi [m3].
  AtElementNodes<3> gradients(const Vector3& xi, double* determinant) const;

  /// int N_a N_b dV (nodes x nodes) [m3].
  MatrixX products() const;
  /// Share of each node in the volume, which adds up to 1. Of 8-node hexahedra an eighth; of quadratic elements in proportion to
  /// the diagonal of `products`, where equal shares or sums of rows would be negative at the corners. Source: E. Hinton, T. Rock,
  /// O. C. Zienkiewicz, Earthquake Eng. Struct. Dyn. 4 (1976) 245-249.
  VectorX mass_shares() const;

 private:
  void check_middle_nodes(int id) const;

  const ReferenceElement* reference_;
  AtElementNodes<3> nodes_;
  double volume_ = 0;
};

}  // namespace wishbone
