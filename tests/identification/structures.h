#pragma once

#include <string>
#include <vector>

#include "identification/methods/released_modes.h"
#include "identification/modal_data.h"

namespace wishbone {

/// A free structure whose truth is known: stiffness, lumped masses, geometry.
struct TestStructure {
  std::vector<int> node_ids;
  Matrix3X nodes;
  VectorX node_mass;
  SparseMatrix K, M;
  MatrixX rigid;  ///< M-orthonormal, from geometry
  std::vector<Freedom> freedoms() const { return all_freedoms(node_ids); }
  Eigen::Index n() const { return K.rows(); }
  /// Elastic free-free modes, by free_free_modes (which is tested against a published table).
  Modes elastic() const;
  Modes with_rigid() const;
};

/// The block of hexahedra of the source, 60 freedoms.
TestStructure chassis();
/// A row of three hexahedra, 1.8 x 0.4 x 0.4 m, 48 freedoms.
TestStructure slender_block();
/// A block with its inner and outer nodes moved about at random (seeded).
TestStructure distorted_block(const Eigen::Vector3i& divisions, unsigned seed);
/// Two legs of hexahedra.
TestStructure l_shape();
/// Masses in a cloud, each joined to all others by axial springs of random stiffness.
TestStructure random_lumped(int count, unsigned seed);

/// All modes of the structure on a support, dense: (K + K_s) x = lambda (M + M_s) x on D x = 0.
Modes modes_on(const TestStructure& structure, const SupportMatrices& support);

/// Springs of one stiffness in x, y and z at each of the nodes.
Support springs_at(const std::vector<int>& nodes, double stiffness);
/// The table 7.1 support of the chassis: x y z of node 1, y of node 18, z of nodes 2 and 17.
Support chassis_joints();
Support joints_at(const std::vector<std::pair<int, std::string>>& axes_of_node);

/// Column "frequency_hz" of a table in tests/data.
std::vector<double> published(const std::string& file);

/// Largest |a / b - 1|.
double worst_relative(const VectorX& a, const VectorX& b);

}  // namespace wishbone
