#include "bodies/mode_set.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "bodies/shape_set.h"
#include "core/error.h"

namespace wishbone {
namespace {

void check_sizes(const ModeSet& set) {
  const Eigen::Index n = set.node_count(), m = set.mode_count();
  const bool fits = set.node_mass.size() == n && set.node_position.cols() == n &&
                    set.shapes.rows() == 3 * n && set.shapes.cols() == m && set.damping_ratio.size() == m;
  if (!fits)
    throw InputError(
        {"mode set",
         fmt::format(
             "{} nodes and {} frequencies need {} masses and positions, {} x {} shapes and {} damping ratios",
             n, m, n, 3 * n, m, m),
         fmt::format("{} masses, {} positions, {} x {} shapes, {} damping ratios", set.node_mass.size(),
                     set.node_position.cols(), set.shapes.rows(), set.shapes.cols(),
                     set.damping_ratio.size()),
         "give every node and every mode its row and column"});
}

void check_frequencies(const ModeSet& set) {
  for (int j = 0; j < set.mode_count(); ++j) {
    if (!(set.omega[j] > 0))
      throw InputError({"mode set", fmt::format("the frequency of elastic mode {} must be positive", j + 1),
                        fmt::format("{:g} rad/s", set.omega[j]),
                        "leave the rigid-body modes out: they are built from geometry"});
    if (j > 0 && set.omega[j] < set.omega[j - 1])
      throw InputError({"mode set", "frequencies must ascend",
                        fmt::format("mode {} at {:g} rad/s", j + 1, set.omega[j]), "sort the modes"});
    if (!(set.damping_ratio[j] >= 0))
      throw InputError({"mode set", fmt::format("the damping ratio of mode {} must not be negative", j + 1),
                        fmt::format("{:g}", set.damping_ratio[j]), "give zero for an undamped mode"});
  }
}

}  // namespace

Matrix3 point_mass_inertia(const VectorX& node_mass, const Matrix3X& node_position) {
  // J = tr(B) 1 - B,  B = sum m_i s_i s_i^T
  const Matrix3 B = node_position * node_mass.asDiagonal() * node_position.transpose();
  return B.trace() * Matrix3::Identity() - B;
}

VectorX mass_of_freedoms(const VectorX& node_mass) {
  return node_mass.transpose().replicate(3, 1).reshaped();
}

MatrixX rigid_body_modes(const VectorX& node_mass, const Matrix3X& node_position) {
  const Matrix3 J = point_mass_inertia(node_mass, node_position);
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(J, Eigen::EigenvaluesOnly);
  if (!(principal.eigenvalues()[0] > 1e-12 * principal.eigenvalues()[2]))
    throw InputError({"mode set", "the nodes of a flexible body must not lie on one line",
                      fmt::format("smallest principal inertia {:g} kg m2", principal.eigenvalues()[0]),
                      "give nodes that span the cross-section too"});

  const Eigen::LLT<Matrix3> L(J);
  const double inverse_root_mass = 1 / std::sqrt(node_mass.sum());
  MatrixX modes(3 * node_mass.size(), 6);
  for (Eigen::Index i = 0; i < node_mass.size(); ++i) {
    modes.block<3, 3>(3 * i, 0) = inverse_root_mass * Matrix3::Identity();
    // -s~ L^-T = (L^-1 s~)^T
    modes.block<3, 3>(3 * i, 3) = L.matrixL().solve(skew(node_position.col(i))).transpose();
  }
  return modes;
}

MatrixX elastic_complement(const VectorX& node_mass, const Matrix3X& node_position) {
  const VectorX root_mass = mass_of_freedoms(node_mass).cwiseSqrt();
  const MatrixX Y = root_mass.asDiagonal() * rigid_body_modes(node_mass, node_position);
  MatrixX Q = MatrixX::Zero(Y.rows(), Y.rows() - Y.cols());
  Q.bottomRows(Q.cols()).setIdentity();
  Q.applyOnTheLeft(Eigen::HouseholderQR<MatrixX>(Y).householderQ());
  return Q;
}

int ModeSet::node_index(int node_id) const {
  const auto found = std::find(node_ids.begin(), node_ids.end(), node_id);
  if (found == node_ids.end())
    throw InputError({"mode set", "there is no such node", fmt::format("node {}", node_id),
                      fmt::format("name one of the {} nodes of the flexible body", node_count())});
  return static_cast<int>(found - node_ids.begin());
}

Matrix3 ModeSet::inertia() const {
  return point_mass_inertia(node_mass, node_position);
}

ModeSet ModeSet::lowest(int count) const {
  if (count < 0 || count > mode_count())
    throw InputError({"mode set", fmt::format("this set has {} modes", mode_count()),
                      fmt::format("{}", count), "ask for at most that many"});
  return {node_ids,
          node_mass,
          node_position,
          omega.head(count),
          shapes.leftCols(count),
          damping_ratio.head(count)};
}

void ModeSet::validate() const {
  check_sizes(*this);
  check_frequencies(*this);
  shapes_of(*this).validate();
}

}  // namespace wishbone
