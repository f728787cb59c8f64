#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "identification/elements/isotropic_material.h"
#include "identification/elements/solid_element.h"

namespace wishbone {

/// Nodes and the elements of one type between them.
struct Mesh {
  std::vector<int> node_ids;  ///< n, names of the nodes
  Matrix3X nodes;             ///< 3 x n [m]
  Eigen::MatrixXi elements;   ///< nodes of an element x ne, columns of `nodes`, ordered as ElementType says
  ElementType type = ElementType::incompatible_modes;

  /// Element number `index` (0-based; errors name it from 1). Throws InputError as ElementGeometry.
  ElementGeometry geometry(int index) const;
  SolidElement element(int index, const Matrix6& elasticity) const;
  /// Rows of x, y, z of the nodes of an element in what is stacked node by node.
  std::vector<int> freedoms(int index) const;
};

/// Block of `size` (lengths along x, y, z) [m], centred on the origin, cut into `divisions` equal 8-node hexahedra
/// along each axis. Node ids count from 1, section by section along x; inside a section they run row by row
/// upwards in z, there and back: the first row along +y, the next along -y, and so on. With one element
/// across, that is (-y -z), (+y -z), (+y +z), (-y +z). Throws InputError unless sizes are positive and divisions at least one.
Mesh make_block(const Vector3& size, const Eigen::Vector3i& divisions,
                ElementType type = ElementType::incompatible_modes);

/// The quadratic elements (20-node hexahedra, 10-node tetrahedra) with the corners of a mesh, straight edges and nodes in their
/// middles, which follow the corners.
Mesh with_middle_nodes(const Mesh& corners, ElementType type = ElementType::hexahedron20);

/// Assembled stiffness K (3n x 3n) over the node displacements, node by node in x, y, z [N/m].
Eigen::SparseMatrix<double> stiffness_matrix(const Mesh& mesh, const IsotropicMaterial& material);

/// Lumped mass of each node (n): its shares (ElementGeometry::mass_shares) of the masses of its elements [kg].
VectorX lumped_mass(const Mesh& mesh, double density);

}  // namespace wishbone
