#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "identification/elements/hexahedron.h"

namespace wishbone {

/// Nodes and the hexahedra between them.
struct HexahedralMesh {
  std::vector<int> node_ids;                       ///< n, names of the nodes
  Matrix3X nodes;                                  ///< 3 x n [m]
  Eigen::Matrix<int, 8, Eigen::Dynamic> elements;  ///< 8 x ne, columns of `nodes`, ordered as in Hexahedron

  /// Element number `index` (0-based; errors name it from 1). Throws InputError if it is inside out.
  Hexahedron element(int index) const;
};

/// Block of `size` (lengths along x, y, z) [m], centred on the origin, cut into `divisions` equal hexahedra
/// along each axis. Node ids count from 1, section by section along x; inside a section they run row by row
/// upwards in z, there and back: the first row along +y, the next along -y, and so on. With one element
/// across, that is (-y -z),
/// (+y -z), (+y +z), (-y +z). Throws InputError unless sizes are positive and divisions at least one.
HexahedralMesh make_block(const Vector3& size, const Eigen::Vector3i& divisions);

/// Assembled stiffness K (3n x 3n) over the node displacements, node by node in x, y, z [N/m].
Eigen::SparseMatrix<double> stiffness_matrix(const HexahedralMesh& mesh, const IsotropicMaterial& material);

/// Lumped mass of each node (n): an eighth of the mass of every element that it belongs to [kg].
VectorX lumped_mass(const HexahedralMesh& mesh, double density);

}  // namespace wishbone
