#pragma once

#include <array>
#include <vector>

#include "bodies/shape_set.h"

namespace wishbone {

/// A lumped finite element model of a free body.
struct NodalModel {
  std::vector<int> node_ids;  ///< n
  VectorX node_mass;          ///< n [kg]
  Matrix3X node_position;     ///< 3 x n, from the mass centre, body axes [m]
  MatrixX stiffness;          ///< 3n x 3n, rows node by node [N/m]
  MatrixX damping;            ///< 3n x 3n [N s/m]; empty: none
};

/// Nodal form with mean axes: z = Q^T M^1/2 delta, the mass-weighted displacements of the nodes, reflected so that the six
/// rigid motions drop out (Q is the complement of the mass-weighted rigid-body modes). 3n - 6 shapes,
///     Phi = M^-1/2 Q,   K_z = Phi^T K Phi,   C_z = Phi^T C Phi.
/// @throws InputError when the nodes lie on one line
ShapeSet mean_axis_shapes(const NodalModel& model);

/// Nodal form with axes fixed on the nodes o, i, j [5.41-5.43]: z holds sqrt(m_k) delta_k for every freedom but six: all three of
/// o, two of i and one of j, chosen among the body axes where they resist a rotation best.
/// @throws InputError when the three nodes lie on one line or one is unknown
ShapeSet fixed_axis_shapes(const NodalModel& model, const std::array<int, 3>& nodes);

}  // namespace wishbone
