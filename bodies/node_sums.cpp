#include "bodies/node_sums.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/dual.h"

namespace wishbone {
namespace {

template <class T>
using PointsT = typename NodePointsT<T>::Points;

/// The points of a p x 3 array as one vector, x rows first: the rows of NodeSums::shapes_.
template <class T>
Eigen::Map<VectorXT<T>> stacked(Eigen::Matrix<T, Eigen::Dynamic, 3>& points) {
  return {points.data(), points.size()};
}
template <class T>
Eigen::Map<const VectorXT<T>> stacked(const Eigen::Matrix<T, Eigen::Dynamic, 3>& points) {
  return {points.data(), points.size()};
}

/// sum a_i x b_i over the rows of two arrays of points.
template <class T>
Vector3T<T> sum_of_cross_products(const Eigen::Matrix<T, Eigen::Dynamic, 3>& a,
                                  const Eigen::Matrix<T, Eigen::Dynamic, 3>& b) {
  return {a.col(1).dot(b.col(2)) - a.col(2).dot(b.col(1)), a.col(2).dot(b.col(0)) - a.col(0).dot(b.col(2)),
          a.col(0).dot(b.col(1)) - a.col(1).dot(b.col(0))};
}

/// J = tr(B) 1 - B,  B = sum b_i b_i^T
template <class T>
Matrix3T<T> inertia(const Eigen::Matrix<T, Eigen::Dynamic, 3>& b) {
  const Matrix3T<T> B = b.transpose().lazyProduct(b);
  Matrix3T<T> J = -B;
  J.diagonal().array() += B.trace();
  return J;
}

/// Interface nodes first, the others after them in their own order.
std::vector<int> interface_first(const ShapeSet& set, const std::vector<int>& interface_nodes) {
  std::vector<int> order = interface_nodes;
  std::vector<bool> taken(set.node_count(), false);
  for (const int node : interface_nodes) taken[node] = true;
  for (int node = 0; node < set.node_count(); ++node)
    if (!taken[node]) order.push_back(node);
  return order;
}

/// Rows sqrt(m_i) [s_x s_y s_z | Psi_x | Psi_y | Psi_z] of the given nodes, p x 3 (m + 1).
MatrixX mass_weighted_rows(const ShapeSet& set, std::span<const int> nodes) {
  const int m = set.shape_count();
  MatrixX rows(nodes.size(), 3 * (m + 1));
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const int i = nodes[r];
    rows.row(r).head<3>() = set.node_position.col(i).transpose();
    for (int axis = 0; axis < 3; ++axis) rows.row(r).segment(3 + axis * m, m) = set.shapes.row(3 * i + axis);
    rows.row(r) *= std::sqrt(set.node_mass[i]);
  }
  return rows;
}

/// As few rows with the same second moments: A = Q R with Q^T Q = 1 gives A^T A = R^T R.
MatrixX equivalent_rows(const MatrixX& rows) {
  if (rows.rows() <= rows.cols()) return rows;
  const Eigen::HouseholderQR<MatrixX> qr(rows);
  return qr.matrixQR().topRows(rows.cols()).triangularView<Eigen::Upper>();
}

}  // namespace

NodeSums::NodeSums(const ShapeSet& set, const std::vector<int>& interface_nodes)
    : node_count_(static_cast<Eigen::Index>(interface_nodes.size())),
      mean_axes_(set.mean_axes),
      inverse_root_mass_(set.node_mass(interface_nodes).cwiseSqrt().cwiseInverse()) {
  const std::vector<int> order = interface_first(set, interface_nodes);
  const std::span<const int> nodes(order);
  const int m = set.shape_count();
  const MatrixX own = mass_weighted_rows(set, nodes.first(interface_nodes.size()));
  const MatrixX others = equivalent_rows(mass_weighted_rows(set, nodes.subspan(interface_nodes.size())));
  MatrixX rows(own.rows() + others.rows(), own.cols());
  rows << own, others;
  s_ = rows.leftCols<3>();
  shapes_.resize(3 * rows.rows(), m);
  for (int axis = 0; axis < 3; ++axis)
    shapes_.middleRows(axis * rows.rows(), rows.rows()) = rows.middleCols(3 + axis * m, m);
}

double NodeSums::operations(const ShapeSet& set, std::size_t interface_nodes) {
  const double m = set.shape_count(), k = static_cast<double>(interface_nodes);
  return 15 * m * (k + std::min(set.node_count() - k, 3 * (m + 1)));
}

template <class T>
void NodeSums::make_arrays(ModalBodyStateT<T>& state) const {
  NodePointsT<T>& points = state.points;
  points.delta = points.b = points.delta_dot = points.bias = PointsT<T>::Zero(s_.rows(), 3);
}

template <class T>
void NodeSums::set_position(bool coupled, ModalBodyStateT<T>& state) const {
  NodePointsT<T>& points = state.points;
  const Eigen::Index p = s_.rows(), k = node_count_;
  // delta_i = Psi_i z,  b_i = s_i + delta_i
  stacked(points.delta).noalias() = shapes_ * state.z;
  points.b = s_ + points.delta;
  state.interface_b.leftCols(k) = (inverse_root_mass_.asDiagonal() * points.b.topRows(k)).transpose();
  state.J = inertia(points.b);
  if (!coupled) return;
  // S = sum b_i x Psi_i; sum s_i x Psi_i vanishes with mean axes
  const auto& moved = mean_axes_ ? points.delta : points.b;
  const auto X = shapes_.topRows(p), Y = shapes_.middleRows(p, p), Z = shapes_.bottomRows(p);
  const auto dx = moved.col(0), dy = moved.col(1), dz = moved.col(2);
  state.S.row(0).noalias() = dy.transpose() * Z;
  state.S.row(0).noalias() -= dz.transpose() * Y;
  state.S.row(1).noalias() = dz.transpose() * X;
  state.S.row(1).noalias() -= dx.transpose() * Z;
  state.S.row(2).noalias() = dx.transpose() * Y;
  state.S.row(2).noalias() -= dy.transpose() * X;
}

template <class T>
void NodeSums::set_velocity(ModalBodyStateT<T>& state) const {
  NodePointsT<T>& points = state.points;
  const Eigen::Index k = node_count_;
  // delta_i' = Psi_i z'
  stacked(points.delta_dot).noalias() = shapes_ * state.zdot;
  state.interface_delta_dot.leftCols(k) =
      (inverse_root_mass_.asDiagonal() * points.delta_dot.topRows(k)).transpose();
  // bias_i = w x (w x b_i) + 2 w x delta_i', a row for each point
  const Matrix3T<T> w = skew(state.w_B), ww = w * w;
  points.bias.noalias() = points.b.lazyProduct(ww.transpose());
  points.bias.noalias() += points.delta_dot.lazyProduct(2.0 * w.transpose());
  // t = sum b_i x bias_i,  h = sum Psi_i^T bias_i
  state.t_bias = sum_of_cross_products(points.b, points.bias);
  state.h_bias.noalias() = shapes_.transpose() * stacked(std::as_const(points.bias));
}

double NodeSums::energy_about_origin(const ModalBodyState& state) const {
  // the rows of b w~ are (b x w)^T
  return 0.5 * (state.points.delta_dot - state.points.b.lazyProduct(skew(state.w_B))).squaredNorm();
}

Vector3 NodeSums::momentum_of_deflection(const ModalBodyState& state) const {
  return sum_of_cross_products(state.points.b, state.points.delta_dot);
}

template void NodeSums::make_arrays(ModalBodyStateT<double>&) const;
template void NodeSums::make_arrays(ModalBodyStateT<Dual>&) const;
template void NodeSums::set_position(bool, ModalBodyStateT<double>&) const;
template void NodeSums::set_position(bool, ModalBodyStateT<Dual>&) const;
template void NodeSums::set_velocity(ModalBodyStateT<double>&) const;
template void NodeSums::set_velocity(ModalBodyStateT<Dual>&) const;

}  // namespace wishbone
