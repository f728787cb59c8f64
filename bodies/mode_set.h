#pragma once

#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// Free-free elastic modes of a body with lumped nodal masses: all that a modal flexible body is made from.
///
/// n nodes with three translations each, m modes. Deflections are delta_i = sum_j Psi_ij z_j in body axes,
/// whose origin Bo is the mass centre of the undeformed body. The modes are mass-normalised and orthogonal to
/// rigid motion,
///     Psi^T M Psi = 1,   sum_i m_i Psi_i = 0,   sum_i m_i s_i x Psi_i = 0,
/// so that the body axes are mean axes and no reference condition has to be imposed on z.
struct ModeSet {
  std::vector<int> node_ids;  ///< n, each once
  VectorX node_mass;          ///< n, m_i > 0 [kg]
  Matrix3X node_position;     ///< 3 x n, s_i from the mass centre, body axes, undeformed [m]
  VectorX omega;              ///< m, angular frequencies, > 0, ascending [rad/s]
  MatrixX shapes;             ///< 3n x m, Psi, rows node by node in x, y, z [1/sqrt(kg)]
  VectorX damping_ratio;      ///< m, zeta >= 0 of each mode [-]

  int node_count() const { return static_cast<int>(node_ids.size()); }
  int mode_count() const { return static_cast<int>(omega.size()); }

  /// Column of `node_position` that belongs to a node id. Throws InputError if there is no such node.
  int node_index(int node_id) const;

  /// sum m_i [kg].
  double mass() const { return node_mass.sum(); }
  /// Inertia about the mass centre of the undeformed body, J = -sum m_i s_i~ s_i~ [kg m2].
  Matrix3 inertia() const;

  /// The same body with only its `count` lowest modes. Throws InputError if it has fewer.
  ModeSet lowest(int count) const;

  /// Throws InputError, with the figure that is wrong, unless the sizes fit, masses and frequencies are
  /// positive, positions are taken about the mass centre, and the modes are mass-orthonormal and orthogonal
  /// to rigid motion within kOrthogonalityTolerance.
  void validate() const;

  static constexpr double kOrthogonalityTolerance = 1e-8;
};

/// Inertia -sum m_i s_i~ s_i~ of mass points about the origin of their positions [kg m2].
Matrix3 point_mass_inertia(const VectorX& node_mass, const Matrix3X& node_position);

/// Diagonal of M (3n): the mass of every node three times, for x, y and z [kg].
VectorX mass_of_freedoms(const VectorX& node_mass);

/// The six rigid-body modes (3n x 6: three translations, three rotations) of mass points whose mass centre is
/// the origin, mass-orthonormal by construction from geometry: with J = L L^T,
///     Psi_0i = [ 1/sqrt(m),  -s_i~ L^-T ].
/// Throws InputError if the nodes lie on one line, for then a rotation moves nothing.
MatrixX rigid_body_modes(const VectorX& node_mass, const Matrix3X& node_position);

/// Q (3n x (3n - 6)), an orthonormal basis of all that is not rigid motion in mass-weighted displacements M^1/2 delta:
///     Q^T M^1/2 Psi_0 = 0,   Q^T Q = 1,
/// the unit vectors of all freedoms but the first six, reflected (Householder). Throws InputError as rigid_body_modes does.
MatrixX elastic_complement(const VectorX& node_mass, const Matrix3X& node_position);

}  // namespace wishbone
