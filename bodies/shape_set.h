#pragma once

#include <vector>

#include "bodies/mode_set.h"

namespace wishbone {

/// What a flexible body deforms by: n lumped nodes with three translations each, and m shapes of which its deflections are
/// made, delta_i = Phi_i z in body axes. The shapes are mass-orthonormal, so z has the unit m sqrt(kg), and
///     T = 1/2 sum m_i |v_Bo + w x (s_i + delta_i) + delta_i'|^2,   V = 1/2 z^T K z,   damping force -C z'.
/// Positions are measured from the mass centre of the undeformed body. How the body axes follow the deforming body is a
/// property of the shapes, the reference condition [5.41-5.54]:
///     mean axes    sum m_i Phi_i = 0 and sum m_i s_i x Phi_i = 0: Bo stays the mass centre
///     fixed axes   the shapes leave three nodes where they are in the body axes, up to six freedoms.
struct ShapeSet {
  std::vector<int> node_ids;  ///< n, each once
  VectorX node_mass;          ///< n, m_i > 0 [kg]
  Matrix3X node_position;     ///< 3 x n, s_i from the mass centre, body axes, undeformed [m]
  MatrixX shapes;             ///< 3n x m, Phi, rows node by node in x, y, z [1/sqrt(kg)]
  MatrixX stiffness;          ///< m x m, or m x 1: the diagonal [1/s^2]
  MatrixX damping;            ///< m x m, or m x 1: the diagonal [1/s]
  /// m x 6m, side by side the symmetric K_ab, ab = xx, yy, zz, xy, xz, yz, of the stiffness that the stresses of a spin with
  /// angular velocity w (body axes) add, K_g(w) = sum_{a <= b} w_a w_b K_ab; empty: none. Dimensionless.
  MatrixX stiffening;
  bool mean_axes = true;

  int node_count() const { return static_cast<int>(node_ids.size()); }
  int shape_count() const { return static_cast<int>(shapes.cols()); }
  /// Whether the shapes are normal modes: K is diagonal, and a mode has an energy of its own.
  bool has_modes() const { return stiffness.cols() == 1; }
  /// Whether neither stiffness nor damping couples the shapes.
  bool uncoupled() const { return stiffness.cols() == 1 && damping.cols() == 1; }
  bool damped() const { return damping.size() > 0 && damping.cwiseAbs().maxCoeff() > 0; }

  /// Column of `node_position` that belongs to a node id. @throws InputError if there is no such node
  int node_index(int node_id) const;

  /// @throws InputError, with the figure that is wrong, unless the sizes fit, masses are positive, positions are taken about
  /// the mass centre, the shapes are mass-orthonormal, with mean axes orthogonal to rigid motion, and stiffness, damping and
  /// stiffening are symmetric
  void validate() const;
};

/// Stiffening (ShapeSet::stiffening) over z as one over q, where z = T q: T^T K_ab T side by side. Of none, none.
MatrixX stiffening_in(const MatrixX& stiffening, const MatrixX& T);

/// The modes as shapes: K = diag(omega^2), C = diag(2 zeta omega), mean axes.
ShapeSet shapes_of(const ModeSet& modes);

/// The way back, of shapes that are modes (has_modes): omega = sqrt(K_jj), zeta = C_jj / (2 omega), by which
/// damping that couples the modes is told of each alone.
ModeSet as_modes(const ShapeSet& set);

}  // namespace wishbone
