#include "identification/structures.h"

#include <fstream>
#include <map>
#include <numeric>
#include <random>

#include "identification/elements/mesh.h"
#include "identification/free_free_modes.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/rigid_modes.h"

namespace wishbone {
namespace {

constexpr IsotropicMaterial kMaterial{2.1e8, 0.3, 2600};

TestStructure make(std::vector<int> ids, Matrix3X nodes, VectorX node_mass, SparseMatrix K) {
  TestStructure s{std::move(ids), std::move(nodes), std::move(node_mass), std::move(K), {}, {}};
  s.M = lumped_mass_matrix(s.node_mass);
  s.rigid = rigid_body_basis(rigid_body_shapes(s.freedoms(), s.node_ids, s.nodes), s.M);
  return s;
}

TestStructure from_mesh(const Mesh& mesh) {
  return make(mesh.node_ids, mesh.nodes, lumped_mass(mesh, kMaterial.density),
              stiffness_matrix(mesh, kMaterial));
}

}  // namespace

Modes TestStructure::elastic() const {
  const ModeSet set = free_free_modes(node_ids, node_mass, nodes, MatrixX(K));
  return {set.omega.cwiseAbs2(), set.shapes};
}

Modes TestStructure::with_rigid() const {
  return with_rigid_body_modes(rigid, elastic());
}

TestStructure chassis() {
  return from_mesh(make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation));
}

TestStructure slender_block() {
  return from_mesh(make_block({1.8, 0.4, 0.4}, {3, 1, 1}, ElementType::mean_dilatation));
}

TestStructure distorted_block(const Eigen::Vector3i& divisions, unsigned seed) {
  Mesh mesh = make_block(divisions.cast<double>() * 0.5, divisions);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.08, 0.08);
  for (double& x : mesh.nodes.reshaped()) x += shift(random);
  return from_mesh(mesh);
}

TestStructure l_shape() {
  // a row of four cells along x and one of three along z that starts on its last cell
  const Mesh foot = make_block({2, 0.5, 0.5}, {4, 1, 1});
  const Mesh leg = make_block({0.5, 0.5, 1.5}, {1, 1, 3});
  Mesh mesh;
  std::map<std::array<long, 3>, int> known;
  std::vector<Vector3> nodes;
  const auto add = [&](const Mesh& part, const Vector3& at) {
    for (Eigen::Index e = 0; e < part.elements.cols(); ++e) {
      mesh.elements.conservativeResize(8, mesh.elements.cols() + 1);
      for (int a = 0; a < 8; ++a) {
        const Vector3 p = part.nodes.col(part.elements(a, e)) + at;
        const std::array<long, 3> key{std::lround(1e6 * p.x()), std::lround(1e6 * p.y()),
                                      std::lround(1e6 * p.z())};
        const auto [found, is_new] = known.emplace(key, static_cast<int>(nodes.size()));
        if (is_new) nodes.push_back(p);
        mesh.elements(a, mesh.elements.cols() - 1) = found->second;
      }
    }
  };
  add(foot, {1, 0, 0.25});
  add(leg, {1.75, 0, 1.25});
  mesh.nodes.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) mesh.nodes.col(static_cast<Eigen::Index>(i)) = nodes[i];
  mesh.node_ids.resize(nodes.size());
  std::iota(mesh.node_ids.begin(), mesh.node_ids.end(), 101);
  return from_mesh(mesh);
}

TestStructure random_lumped(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1), mass(0.5, 3), rate(1e4, 1e6);
  std::vector<int> ids(static_cast<std::size_t>(count));
  std::iota(ids.begin(), ids.end(), 1);
  Matrix3X nodes(3, count);
  VectorX node_mass(count);
  for (double& x : nodes.reshaped()) x = place(random);
  for (double& m : node_mass) m = mass(random);
  MatrixX K = MatrixX::Zero(3 * count, 3 * count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector3 u = (nodes.col(i) - nodes.col(j)).normalized();
      const Matrix3 k = rate(random) * u * u.transpose();
      K.block<3, 3>(3 * i, 3 * i) += k;
      K.block<3, 3>(3 * j, 3 * j) += k;
      K.block<3, 3>(3 * i, 3 * j) -= k;
      K.block<3, 3>(3 * j, 3 * i) -= k;
    }
  return make(std::move(ids), nodes, node_mass, K.sparseView());
}

Modes modes_on(const TestStructure& structure, const SupportMatrices& support) {
  return model_modes(structure.K, structure.M, support);
}

Support springs_at(const std::vector<int>& nodes, double stiffness) {
  Support support;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) support.springs.push_back({node, Vector3::Unit(axis), stiffness});
  return support;
}

Support joints_at(const std::vector<std::pair<int, std::string>>& axes_of_node) {
  Support support;
  for (const auto& [node, axes] : axes_of_node)
    for (const char axis : axes) support.joints.push_back({node, Vector3::Unit(axis - 'x')});
  return support;
}

Support chassis_joints() {
  return joints_at({{1, "xyz"}, {18, "y"}, {2, "z"}, {17, "z"}});
}

std::vector<double> published(const std::string& file) {
  std::ifstream in(std::string(WISHBONE_TEST_DATA "/") + file);
  std::vector<double> frequencies;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
      frequencies.push_back(std::stod(line.substr(line.find(',') + 1)));
  return frequencies;
}

double worst_relative(const VectorX& a, const VectorX& b) {
  return (a.array() / b.array() - 1).abs().maxCoeff();
}

}  // namespace wishbone
