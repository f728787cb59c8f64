#include "identification/elements/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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

ElementGeometry Mesh::geometry(int index) const {
  return ElementGeometry(type, nodes(Eigen::all, elements.col(index)), index + 1);
}

SolidElement Mesh::element(int index, const Matrix6& elasticity) const {
  return SolidElement(type, nodes(Eigen::all, elements.col(index)), elasticity, index + 1);
}

std::vector<int> Mesh::freedoms(int index) const {
  std::vector<int> rows;
  for (const int node : elements.col(index))
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * node + axis);
  return rows;
}

Mesh make_block(const Vector3& size, const Eigen::Vector3i& divisions, ElementType type) {
  check_block(size, divisions);
  const BlockNumbering node{divisions};
  Mesh mesh;
  mesh.type = type;
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

Mesh with_middle_nodes(const Mesh& corners, ElementType type) {
  const ReferenceElement& reference = reference_element(type);
  const int known = static_cast<int>(corners.nodes.cols());
  Mesh mesh{corners.node_ids, {}, Eigen::MatrixXi(reference.nodes, corners.elements.cols()), type};
  std::map<std::pair<int, int>, int> middle_of;
  std::vector<Vector3> middles;
  for (int e = 0; e < corners.elements.cols(); ++e) {
    mesh.elements.col(e).head(reference.corners()) = corners.elements.col(e);
    int place = reference.corners();
    for (const auto& [first, second] : reference.edges) {
      const int a = corners.elements(first, e), b = corners.elements(second, e);
      const auto [found, is_new] =
          middle_of.emplace(std::minmax(a, b), known + static_cast<int>(middles.size()));
      if (is_new) middles.push_back(0.5 * (corners.nodes.col(a) + corners.nodes.col(b)));
      mesh.elements(place++, e) = found->second;
    }
  }
  mesh.nodes.resize(3, known + static_cast<Eigen::Index>(middles.size()));
  mesh.nodes.leftCols(known) = corners.nodes;
  int id = *std::max_element(mesh.node_ids.begin(), mesh.node_ids.end());
  for (std::size_t i = 0; i < middles.size(); ++i) {
    mesh.nodes.col(known + static_cast<Eigen::Index>(i)) = middles[i];
    mesh.node_ids.push_back(++id);
  }
  return mesh;
}

Eigen::SparseMatrix<double> stiffness_matrix(const Mesh& mesh, const IsotropicMaterial& material) {
  material.validate();
  const Matrix6 elasticity = material.elasticity();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(9 * mesh.elements.rows() * mesh.elements.size()));
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const MatrixX K_e = mesh.element(e, elasticity).stiffness();
    const std::vector<int> row = mesh.freedoms(e);
    for (int c = 0; c < K_e.cols(); ++c)
      for (int r = 0; r < K_e.rows(); ++r)
        entries.emplace_back(row[static_cast<std::size_t>(r)], row[static_cast<std::size_t>(c)], K_e(r, c));
  }
  Eigen::SparseMatrix<double> K(mesh.nodes.size(), mesh.nodes.size());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

VectorX lumped_mass(const Mesh& mesh, double density) {
  VectorX mass = VectorX::Zero(mesh.nodes.cols());
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const ElementGeometry geometry = mesh.geometry(e);
    mass(mesh.elements.col(e)) += density * geometry.volume() * geometry.mass_shares();
  }
  return mass;
}

}  // namespace wishbone
