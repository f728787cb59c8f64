#include "bodies/modal_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/axis_pairs.h"
#include "core/dual.h"
#include "core/error.h"

namespace wishbone {
namespace {

/// Columns of the interface nodes in the set.
std::vector<int> columns_of(const ShapeSet& set, const std::vector<int>& node_ids) {
  std::vector<int> columns;
  for (const int id : node_ids) {
    columns.push_back(set.node_index(id));
    if (std::count(columns.begin(), columns.end(), columns.back()) > 1)
      throw InputError({"modal body", "an interface node must be named once", fmt::format("node {}", id),
                        "let every joint and force at this node share one interface"});
  }
  return columns;
}

std::variant<NodeSums, InertiaInvariants> make_inertia(const ShapeSet& set, const std::vector<int>& nodes,
                                                       InertiaMethod method) {
  const bool cheaper =
      InertiaInvariants::operations(set, nodes.size()) < NodeSums::operations(set, nodes.size());
  if (method == InertiaMethod::invariants || (method == InertiaMethod::cheaper && cheaper))
    return InertiaInvariants(set, nodes);
  return NodeSums(set, nodes);
}

/// sum += matrix z, with a matrix or its diagonal.
template <class T>
void add_product(const MatrixX& matrix, const VectorXT<T>& z, VectorXT<T>& sum) {
  if (matrix.cols() == 1)
    sum += matrix.col(0).cwiseProduct(z);
  else
    sum.noalias() += matrix * z;
}

}  // namespace

ModalBody::ModalBody(const ModeSet& modes, const std::vector<int>& interface_node_ids,
                     const std::vector<InterfaceFrame>& frames, InertiaTerms terms, InertiaMethod method)
    : ModalBody((modes.validate(), shapes_of(modes)), interface_node_ids, frames, terms, method) {}

ModalBody::ModalBody(ShapeSet set, const std::vector<int>& interface_node_ids,
                     const std::vector<InterfaceFrame>& frames, InertiaTerms terms, InertiaMethod method)
    : set_((set.validate(), std::move(set))),
      terms_(terms),
      mass_(set_.node_mass.sum()),
      node_count_(static_cast<int>(interface_node_ids.size())),
      inertia_(make_inertia(set_, columns_of(set_, interface_node_ids), method)) {
  if (!mean_axes()) {
    P_ = Matrix3X::Zero(3, mode_count());
    for (int i = 0; i < set_.node_count(); ++i) P_ += set_.node_mass[i] * set_.shapes.middleRows<3>(3 * i);
  }
  for (const int id : interface_node_ids)
    interface_shapes_.push_back(set_.shapes.middleRows<3>(3 * set_.node_index(id)));
  frame_origins_.resize(3, static_cast<Eigen::Index>(frames.size()));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    FrameShapes shapes = frame_shapes(frames[f], set_);
    frame_origins_.col(static_cast<Eigen::Index>(f)) = shapes.origin;
    interface_shapes_.push_back(std::move(shapes.translation));
    frame_rotations_.push_back(std::move(shapes.rotation));
  }
}

InertiaMethod ModalBody::inertia_method() const {
  return std::holds_alternative<NodeSums>(inertia_) ? InertiaMethod::node_sums : InertiaMethod::invariants;
}

double ModalBody::operations(InertiaMethod method) const {
  return method == InertiaMethod::node_sums ? NodeSums::operations(set_, node_count_)
                                            : InertiaInvariants::operations(set_, node_count_);
}

template <class T>
ModalBodyStateT<T> ModalBody::make_state() const {
  const int m = mode_count(), k = interface_count();
  ModalBodyStateT<T> state;
  state.z = state.zdot = state.h_bias = VectorXT<T>::Zero(m);
  state.S = Matrix3XT<T>::Zero(3, m);
  state.interface_b = state.interface_delta_dot = Matrix3XT<T>::Zero(3, k);
  state.turns.resize(frame_rotations_.size());
  state.stiffening_z.setZero(set_.stiffening.size() > 0 ? m : 0, 6);
  std::visit([&](const auto& inertia) { inertia.make_arrays(state); }, inertia_);
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
  state.z = Eigen::Map<const VectorXT<T>>(z, mode_count());
  const bool coupled = terms_ == InertiaTerms::consistent;
  std::visit([&](const auto& inertia) { inertia.set_position(coupled, state); }, inertia_);
  place_frames(state);
  if (!mean_axes()) state.c.noalias() = P_ * state.z;  // sum m_i s_i = 0
  if (state.stiffening_z.rows() > 0) shorten(state);
}

template <class T>
void ModalBody::set_velocity(const Vector3T<T>& w_B, const T* zdot, ModalBodyStateT<T>& state) const {
  state.w_B = w_B;
  state.zdot = Eigen::Map<const VectorXT<T>>(zdot, mode_count());
  std::visit([&](const auto& inertia) { inertia.set_velocity(state); }, inertia_);
  move_frames(state);
  add_product(set_.damping, state.zdot, state.h_bias);
  add_product(set_.stiffness, state.z, state.h_bias);
  if (state.stiffening_z.rows() > 0) add_stiffening(state);
  if (!mean_axes()) {
    const Vector3T<T> c_rate = P_ * state.zdot;
    state.f_bias = w_B.cross(w_B.cross(state.c) + 2.0 * c_rate);
  }
}

// J - Gamma,  w^T Gamma w = sum_{a <= b} w_a w_b z^T K_ab z
template <class T>
void ModalBody::shorten(ModalBodyStateT<T>& state) const {
  const Eigen::Index m = mode_count();
  for (int pair = 0; pair < 6; ++pair)
    state.stiffening_z.col(pair).noalias() = set_.stiffening.middleCols(pair * m, m) * state.z;
  const Eigen::Matrix<T, 6, 1> moments = state.stiffening_z.transpose().lazyProduct(state.z);
  state.shortening = matrix_of_form(moments);
  state.J -= state.shortening;
}

// t_bias - Gamma' w - w x (Gamma w),   h_bias + sum_{a <= b} w_a w_b K_ab z
template <class T>
void ModalBody::add_stiffening(ModalBodyStateT<T>& state) const {
  const Vector3T<T>& w = state.w_B;
  const Eigen::Matrix<T, 6, 1> rates = 2.0 * state.stiffening_z.transpose().lazyProduct(state.zdot);
  const Vector3T<T> momentum = state.shortening * w;
  state.t_bias -= matrix_of_form(rates) * w + w.cross(momentum);
  state.h_bias.noalias() += state.stiffening_z.lazyProduct(products_of_components(w));
}

double ModalBody::kinetic_energy(const Vector3& v_WBo_B, const ModalBodyState& state) const {
  const double about_origin =
      std::visit([&](const auto& inertia) { return inertia.energy_about_origin(state); }, inertia_);
  return about_origin - 0.5 * state.w_B.dot(state.shortening * state.w_B) +
         v_WBo_B.dot(linear_momentum(v_WBo_B, state)) - 0.5 * mass_ * v_WBo_B.squaredNorm();
}

double ModalBody::elastic_energy(const ModalBodyState& state) const {
  if (set_.has_modes()) return 0.5 * set_.stiffness.col(0).dot(state.z.cwiseAbs2());
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
  return state.c.cross(v_WBo_B) + state.J * state.w_B +
         std::visit([&](const auto& inertia) { return inertia.momentum_of_deflection(state); }, inertia_);
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
