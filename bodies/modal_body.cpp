#include "bodies/modal_body.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/dual.h"
#include "core/error.h"

namespace wishbone {
namespace {

template <class T>
using PointsT = typename ModalBodyStateT<T>::Points;
using Points = PointsT<double>;

/// The points of a p x 3 array as one vector, x rows first: the rows of ModalBody::shapes_.
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
std::vector<int> interface_first(const ShapeSet& modes, const std::vector<int>& interface_node_ids) {
  std::vector<int> order;
  std::vector<bool> taken(modes.node_count(), false);
  for (int id : interface_node_ids) {
    const int node = modes.node_index(id);
    if (taken[node])
      throw InputError({"modal body", "an interface node must be named once", fmt::format("node {}", id),
                        "let every joint and force at this node share one interface"});
    taken[node] = true;
    order.push_back(node);
  }
  for (int node = 0; node < modes.node_count(); ++node)
    if (!taken[node]) order.push_back(node);
  return order;
}

/// Rows sqrt(m_i) [s_x s_y s_z | Psi_x | Psi_y | Psi_z] of the given nodes, p x 3 (m + 1).
MatrixX mass_weighted_rows(const ShapeSet& modes, std::span<const int> nodes) {
  const int m = modes.shape_count();
  MatrixX rows(nodes.size(), 3 * (m + 1));
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const int i = nodes[r];
    rows.row(r).head<3>() = modes.node_position.col(i).transpose();
    for (int axis = 0; axis < 3; ++axis)
      rows.row(r).segment(3 + axis * m, m) = modes.shapes.row(3 * i + axis);
    rows.row(r) *= std::sqrt(modes.node_mass[i]);
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

ModalBody::ModalBody(const ModeSet& modes, const std::vector<int>& interface_node_ids,
                     const std::vector<InterfaceFrame>& frames, InertiaTerms terms)
    : ModalBody((modes.validate(), shapes_of(modes)), interface_node_ids, frames, terms) {}

ModalBody::ModalBody(ShapeSet set, const std::vector<int>& interface_node_ids,
                     const std::vector<InterfaceFrame>& frames, InertiaTerms terms)
    : set_(std::move(set)), terms_(terms), node_count_(static_cast<int>(interface_node_ids.size())) {
  set_.validate();
  mass_ = set_.node_mass.sum();
  if (!mean_axes()) {
    P_ = Matrix3X::Zero(3, mode_count());
    for (int i = 0; i < set_.node_count(); ++i) P_ += set_.node_mass[i] * set_.shapes.middleRows<3>(3 * i);
  }

  const std::vector<int> order = interface_first(set_, interface_node_ids);
  const std::span<const int> nodes(order);
  const int k = node_count_, m = mode_count();
  inverse_root_mass_.resize(k);
  for (int i = 0; i < k; ++i) {
    interface_shapes_.push_back(set_.shapes.middleRows<3>(3 * order[i]));
    inverse_root_mass_[i] = 1 / std::sqrt(set_.node_mass[order[i]]);
  }
  frame_origins_.resize(3, static_cast<Eigen::Index>(frames.size()));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    FrameShapes shapes = frame_shapes(frames[f], set_);
    frame_origins_.col(static_cast<Eigen::Index>(f)) = shapes.origin;
    interface_shapes_.push_back(std::move(shapes.translation));
    frame_rotations_.push_back(std::move(shapes.rotation));
  }

  const MatrixX own = mass_weighted_rows(set_, nodes.first(k));
  const MatrixX others = equivalent_rows(mass_weighted_rows(set_, nodes.subspan(k)));
  MatrixX rows(own.rows() + others.rows(), own.cols());
  rows << own, others;
  s_ = rows.leftCols<3>();
  shapes_.resize(3 * rows.rows(), m);
  for (int axis = 0; axis < 3; ++axis)
    shapes_.middleRows(axis * rows.rows(), rows.rows()) = rows.middleCols(3 + axis * m, m);
}

template <class T>
ModalBodyStateT<T> ModalBody::make_state() const {
  const int m = mode_count(), k = interface_count();
  ModalBodyStateT<T> state;
  state.z = state.zdot = state.h_bias = VectorXT<T>::Zero(m);
  state.S = Matrix3XT<T>::Zero(3, m);
  state.interface_b = state.interface_delta_dot = Matrix3XT<T>::Zero(3, k);
  state.turns.resize(frame_rotations_.size());
  state.delta = state.b = state.delta_dot = state.bias = PointsT<T>::Zero(s_.rows(), 3);
  const VectorXT<T> rest = VectorXT<T>::Zero(m);
  set_position<T>(rest.data(), state);
  set_velocity<T>(Vector3T<T>::Zero(), rest.data(), state);
  return state;
}

template <class T>
void ModalBody::place_frames(ModalBodyStateT<T>& state) const {
  for (std::size_t f = 0; f < state.turns.size(); ++f) {
    const auto i = static_cast<Eigen::Index>(f), interface = node_count_ + i;
    const Vector3T<T> u = interface_shapes_[interface] * state.z, phi = frame_rotations_[f] * state.z;
    state.interface_b.col(interface) = frame_origins_.col(i) + u;
    state.turns[f].set_position(phi);
  }
}

template <class T>
void ModalBody::move_frames(ModalBodyStateT<T>& state) const {
  for (std::size_t f = 0; f < state.turns.size(); ++f) {
    const Eigen::Index interface = node_count_ + static_cast<Eigen::Index>(f);
    const Vector3T<T> phi_rate = frame_rotations_[f] * state.zdot;
    state.interface_delta_dot.col(interface) = interface_shapes_[interface] * state.zdot;
    state.turns[f].set_velocity(phi_rate);
  }
}

template <class T>
void ModalBody::set_position(const T* z, ModalBodyStateT<T>& state) const {
  const Eigen::Index p = s_.rows(), k = node_count_;
  state.z = Eigen::Map<const VectorXT<T>>(z, mode_count());
  // delta_i = Psi_i z,  b_i = s_i + delta_i
  stacked(state.delta).noalias() = shapes_ * state.z;
  state.b = s_ + state.delta;
  state.interface_b.leftCols(k) = (inverse_root_mass_.asDiagonal() * state.b.topRows(k)).transpose();
  place_frames(state);
  state.J = inertia(state.b);
  if (!mean_axes()) state.c.noalias() = P_ * state.z;  // sum m_i s_i = 0
  if (terms_ == InertiaTerms::source) return;
  // S = sum b_i x Psi_i; sum s_i x Psi_i vanishes with mean axes
  const auto& moved = mean_axes() ? state.delta : state.b;
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
void ModalBody::set_velocity(const Vector3T<T>& w_B, const T* zdot, ModalBodyStateT<T>& state) const {
  const Eigen::Index k = node_count_;
  state.w_B = w_B;
  state.zdot = Eigen::Map<const VectorXT<T>>(zdot, mode_count());
  // delta_i' = Psi_i z'
  stacked(state.delta_dot).noalias() = shapes_ * state.zdot;
  state.interface_delta_dot.leftCols(k) =
      (inverse_root_mass_.asDiagonal() * state.delta_dot.topRows(k)).transpose();
  move_frames(state);
  // bias_i = w x (w x b_i) + 2 w x delta_i', a row for each point
  const Matrix3T<T> w = skew(w_B), ww = w * w;
  state.bias.noalias() = state.b.lazyProduct(ww.transpose());
  state.bias.noalias() += state.delta_dot.lazyProduct(2.0 * w.transpose());
  // t = sum b_i x bias_i,  h = sum Psi_i^T bias_i + C z' + K z
  state.t_bias = sum_of_cross_products(state.b, state.bias);
  state.h_bias.noalias() = shapes_.transpose() * stacked(std::as_const(state.bias));
  add_product(set_.damping, state.zdot, state.h_bias);
  add_product(set_.stiffness, state.z, state.h_bias);
  if (!mean_axes()) {
    const Vector3T<T> c_rate = P_ * state.zdot;
    state.f_bias = ww * state.c + 2.0 * w_B.cross(c_rate);
  }
}

template <class T>
void ModalBody::add_product(const MatrixX& matrix, const VectorXT<T>& z, VectorXT<T>& sum) const {
  if (matrix.cols() == 1)
    sum += matrix.col(0).cwiseProduct(z);
  else
    sum.noalias() += matrix * z;
}

double ModalBody::kinetic_energy(const Vector3& v_WBo_B, const ModalBodyState& state) const {
  // sum m_i |w x b_i + delta_i'|^2, point by point: S is not there with the terms of the source
  const Matrix3 w = skew(state.w_B);
  return 0.5 * (state.delta_dot - state.b.lazyProduct(w)).squaredNorm() +
         v_WBo_B.dot(linear_momentum(v_WBo_B, state)) - 0.5 * mass_ * v_WBo_B.squaredNorm();
}

double ModalBody::elastic_energy(const ModalBodyState& state) const {
  if (set_.stiffness.cols() == 1) return 0.5 * set_.stiffness.col(0).dot(state.z.cwiseAbs2());
  return 0.5 * state.z.dot(set_.stiffness.lazyProduct(state.z));
}

double ModalBody::mode_energy(int mode, const ModalBodyState& state) const {
  return 0.5 *
         (state.zdot[mode] * state.zdot[mode] + set_.stiffness(mode, 0) * state.z[mode] * state.z[mode]);
}

template <class T>
T ModalBody::damping_power(const ModalBodyStateT<T>& state) const {
  T power(0);
  for (Eigen::Index k = 0; k < set_.damping.cols(); ++k)
    for (Eigen::Index j = 0; j < set_.damping.rows(); ++j)
      power += set_.damping(j, k) * state.zdot[j] * state.zdot[set_.damping.cols() == 1 ? j : k];
  return power;
}

Vector3 ModalBody::linear_momentum(const Vector3& v_WBo_B, const ModalBodyState& state) const {
  // m v + w x c + P z'
  Vector3 p = mass_ * v_WBo_B;
  if (!mean_axes()) p += state.w_B.cross(state.c) + P_ * state.zdot;
  return p;
}

Vector3 ModalBody::angular_momentum(const Vector3& v_WBo_B, const ModalBodyState& state) const {
  // c x v + J w + sum m_i b_i x delta_i'
  return state.c.cross(v_WBo_B) + state.J * state.w_B + sum_of_cross_products(state.b, state.delta_dot);
}

Vector3 ModalBody::deflection(int node_id, const ModalBodyState& state) const {
  return set_.shapes.middleRows<3>(3 * set_.node_index(node_id)) * state.z;
}

template ModalBodyStateT<double> ModalBody::make_state<double>() const;
template ModalBodyStateT<Dual> ModalBody::make_state<Dual>() const;
template void ModalBody::set_position(const double*, ModalBodyStateT<double>&) const;
template void ModalBody::set_position(const Dual*, ModalBodyStateT<Dual>&) const;
template void ModalBody::set_velocity(const Vector3&, const double*, ModalBodyStateT<double>&) const;
template void ModalBody::set_velocity(const Vector3T<Dual>&, const Dual*, ModalBodyStateT<Dual>&) const;
template double ModalBody::damping_power(const ModalBodyStateT<double>&) const;
template Dual ModalBody::damping_power(const ModalBodyStateT<Dual>&) const;

}  // namespace wishbone
