#include "identification/elements/hexahedral_mesh.h"

#include <fmt/format.h>

#include <numeric>

#include "core/error.h"

namespace wishbone {
namespace {

void check_block(const Vector3& size, const Eigen::Vector3i& divisions) {
  if (!(size.minCoeff() > 0))
    throw InputError({"block", "the three lengths must be positive",
                      fmt::format("{:g} x {:g} x {:g} m", size.x(), size.y(), size.z()),
                      "give them in metres"});
  if (divisions.minCoeff() < 1)
    throw InputError({"block", "there must be at least one element along each axis",
                      fmt::format("{} x {} x {}", divisions.x(), divisions.y(), divisions.z()),
                      "give whole numbers"});
}

/// Numbers the nodes of a block: section i along x, row k along z there and back, place j along y.
struct BlockNumbering {
  Eigen::Vector3i divisions;

  int node_count() const { return (divisions + Eigen::Vector3i::Ones()).prod(); }
  int operator()(int i, int j, int k) const {
    const int row_length = divisions.y() + 1;
    const int place = k % 2 == 0 ? j : divisions.y() - j;
    return (i * (divisions.z() + 1) + k) * row_length + place;
  }
};

}  // namespace

Hexahedron HexahedralMesh::element(int index) const {
  return Hexahedron(nodes(Eigen::all, elements.col(index)), index + 1);
}

HexahedralMesh make_block(const Vector3& size, const Eigen::Vector3i& divisions) {
  check_block(size, divisions);
  const BlockNumbering node{divisions};
  HexahedralMesh mesh;
  mesh.node_ids.resize(node.node_count());
  std::iota(mesh.node_ids.begin(), mesh.node_ids.end(), 1);

  mesh.nodes.resize(3, node.node_count());
  for (int i = 0; i <= divisions.x(); ++i)
    for (int k = 0; k <= divisions.z(); ++k)
      for (int j = 0; j <= divisions.y(); ++j) {
        const Vector3 fraction = Vector3(i, j, k).cwiseQuotient(divisions.cast<double>());
        mesh.nodes.col(node(i, j, k)) = (fraction.array() - 0.5).matrix().cwiseProduct(size);
      }

  // Local axes (xi, eta, zeta) along (y, z, x), so that an element's first face lies in its first section.
  mesh.elements.resize(8, divisions.prod());
  int e = 0;
  for (int i = 0; i < divisions.x(); ++i)
    for (int k = 0; k < divisions.z(); ++k)
      for (int j = 0; j < divisions.y(); ++j)
        mesh.elements.col(e++) << node(i, j, k), node(i, j + 1, k), node(i, j + 1, k + 1), node(i, j, k + 1),
            node(i + 1, j, k), node(i + 1, j + 1, k), node(i + 1, j + 1, k + 1), node(i + 1, j, k + 1);
  return mesh;
}

Eigen::SparseMatrix<double> stiffness_matrix(const HexahedralMesh& mesh, const IsotropicMaterial& material) {
  material.validate();
  const Matrix6 elasticity = material.elasticity();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(24 * 24 * mesh.elements.cols());
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const Hexahedron::Stiffness K_e = mesh.element(e).stiffness(elasticity);
    const auto row = [&](int local) { return 3 * mesh.elements(local / 3, e) + local % 3; };
    for (int c = 0; c < 24; ++c)
      for (int r = 0; r < 24; ++r) entries.emplace_back(row(r), row(c), K_e(r, c));
  }
  Eigen::SparseMatrix<double> K(mesh.nodes.size(), mesh.nodes.size());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

VectorX lumped_mass(const HexahedralMesh& mesh, double density) {
  VectorX mass = VectorX::Zero(mesh.nodes.cols());
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const double share = density * mesh.element(e).volume() / 8;
    for (int node : mesh.elements.col(e)) mass[node] += share;
  }
  return mass;
}

}  // namespace wishbone
