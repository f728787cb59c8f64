#include "identification/measured.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "identification/methods/support_matrices.h"

namespace wishbone {

ModalData measured_on(const TestStructure& structure, const Support& support, Eigen::Index lowest) {
  Modes modes = modes_on(structure, support_matrices(support, structure.freedoms()));
  const Eigen::Index unheld = (modes.lambda.array() <= 1e-9 * modes.lambda.maxCoeff()).count();
  modes = {modes.lambda.tail(modes.count() - unheld), modes.shapes.rightCols(modes.count() - unheld)};
  if (lowest >= 0) modes = modes.lowest(lowest);
  ModalData data;
  data.node_ids = structure.node_ids;
  data.node_position = structure.nodes;
  data.node_mass = structure.node_mass;
  data.freedoms = structure.freedoms();
  data.omega = modes.lambda.cwiseSqrt();
  data.shapes = modes.shapes;
  data.damping_ratio = VectorX::Zero(modes.count());
  data.modal_mass = VectorX::Ones(modes.count());
  data.support = support;
  return data;
}

AnalyticalModel model_of(const TestStructure& structure) {
  return {structure.node_ids, structure.nodes, structure.node_mass, structure.M, structure.K, {}};
}

ModalData seen_at(const std::vector<int>& nodes, const ModalData& data) {
  ModalData seen = data;
  std::vector<int> columns, rows;
  for (const int node : nodes) columns.push_back(data.node_index(node));
  seen.node_ids = nodes;
  seen.freedoms = all_freedoms(nodes);
  for (const Freedom& freedom : seen.freedoms) rows.push_back(*data.row(freedom));
  seen.node_position = data.node_position(Eigen::all, columns);
  seen.node_mass = data.node_mass(columns);
  seen.shapes = data.shapes(rows, Eigen::all);
  return seen;
}

VectorX true_frequencies(const MatrixX& K, const MatrixX& M, bool is_free, const std::vector<int>& held) {
  std::vector<int> left;
  for (int i = 0; i < K.rows(); ++i)
    if (std::find(held.begin(), held.end(), i) == held.end()) left.push_back(i);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(
      MatrixX(K(left, left)), MatrixX(M(left, left)), Eigen::EigenvaluesOnly);
  const VectorX& lambda = eigen.eigenvalues();
  return lambda.tail(lambda.size() - (is_free ? 6 : 0)).cwiseSqrt() / (2 * std::numbers::pi);
}

double plane_distance(const MatrixX& A, const MatrixX& B, const SparseMatrix& M) {
  const auto orthonormal = [&](const MatrixX& X) -> MatrixX {
    const Eigen::LLT<MatrixX> L(X.transpose() * (M * X));
    return L.matrixL().solve(X.transpose()).transpose();
  };
  const MatrixX a = orthonormal(A), b = orthonormal(B);
  const MatrixX left = b - a * (a.transpose() * (M * b));
  return std::sqrt((left.transpose() * (M * left)).diagonal().maxCoeff());
}

Support chassis_springs() {
  return springs_at({1, 2, 17, 18}, 47e3);
}

Support chassis_springs_with_masses() {
  Support support = chassis_springs();
  support.masses = {{1, 3}, {18, 1}};
  return support;
}

Support chassis_sensors() {
  Support support;
  support.masses = {{3, 2}, {12, 0.5}};
  return support;
}

Support chassis_bounce_springs() {
  Support support;
  for (const int node : {1, 2, 17}) support.springs.push_back({node, Vector3::UnitZ(), 47e3});
  support.masses = {{3, 2}};
  return support;
}

Support chassis_joint_and_springs() {
  Support support = joints_at({{1, "xyz"}});
  support.springs = {{18, Vector3::UnitY(), 3e5}, {2, Vector3::UnitZ(), 2e5}, {17, Vector3::UnitZ(), 4e5}};
  support.masses = {{20, 0.4}};
  return support;
}

IdentificationTask task_on(const TestStructure& structure, const Support& support, Eigen::Index lowest) {
  IdentificationTask task;
  task.measured = measured_on(structure, support, lowest);
  return task;
}

VectorX frequencies(const Identification& found) {
  return found.modes.omega / (2 * std::numbers::pi);
}

VectorX free_frequencies(const TestStructure& structure) {
  return true_frequencies(structure.K, structure.M, true);
}

}  // namespace wishbone
