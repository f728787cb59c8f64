#include "bodies/inertia_invariants.h"

#include <array>

#include "core/axis_pairs.h"
#include "core/dual.h"

namespace wishbone {
namespace {

/// sqrt(m_i) [s_a Psi_a], n x (m + 1).
MatrixX mass_weighted(const ShapeSet& set, int axis) {
  MatrixX P(set.node_count(), set.shape_count() + 1);
  for (int i = 0; i < set.node_count(); ++i)
    P.row(i) << set.node_position(axis, i), set.shapes.row(3 * i + axis);
  return set.node_mass.cwiseSqrt().asDiagonal() * P;
}

}  // namespace

InertiaInvariants::InertiaInvariants(const ShapeSet& set, const std::vector<int>& interface_nodes)
    : m_(set.shape_count()),
      s_(set.node_position(Eigen::all, interface_nodes)),
      interface_(3 * interface_nodes.size(), m_),
      symmetric_(6 * (m_ + 1), m_ + 1),
      skew_(3 * m_, m_ + 1) {
  for (std::size_t i = 0; i < interface_nodes.size(); ++i)
    interface_.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        set.shapes.middleRows<3>(3 * interface_nodes[i]);

  const std::array<MatrixX, 3> P{mass_weighted(set, 0), mass_weighted(set, 1), mass_weighted(set, 2)};
  for (int pair = 0; pair < 6; ++pair) {
    const auto [a, b] = kAxisPairs[pair];
    const MatrixX N = P[a].transpose() * P[b];
    symmetric_.middleRows(pair * (m_ + 1), m_ + 1) = a == b ? N : MatrixX(N + N.transpose());
    if (a == b) continue;
    // D_c = N_ba - N_ab for (a, b, c) = (y, z, x) and cyclic
    const int c = 3 - a - b;
    const MatrixX D = (b - a == 1 ? 1.0 : -1.0) * (N.transpose() - N);
    skew_.middleRows(c * m_, m_) = D.bottomRows(m_);
  }
  if (set.mean_axes) skew_.col(0).setZero();  // sum m_i s_i x Psi_i
}

double InertiaInvariants::operations(const ShapeSet& set, std::size_t interface_nodes) {
  const double m = set.shape_count();
  return 12 * m * m + 6 * m * static_cast<double>(interface_nodes);
}

template <class T>
void InertiaInvariants::make_arrays(ModalBodyStateT<T>& state) const {
  InvariantProductsT<T>& products = state.products;
  products.y = VectorXT<T>::Zero(m_ + 1);
  products.y[0] = T(1);
  products.symmetric = VectorXT<T>::Zero(symmetric_.rows());
  products.skew = products.skew_dot = VectorXT<T>::Zero(skew_.rows());
}

template <class T>
void InertiaInvariants::set_position(bool coupled, ModalBodyStateT<T>& state) const {
  InvariantProductsT<T>& products = state.products;
  products.y.tail(m_) = state.z;
  products.symmetric.noalias() = symmetric_ * products.y;
  products.skew.noalias() = skew_ * products.y;
  Eigen::Map<VectorXT<T>> interface_b(state.interface_b.data(), s_.size());
  interface_b = s_.reshaped();
  interface_b.noalias() += interface_ * state.z;
  // B_ab = 1/2 y^T (N_ab + N_ba) y,  J = tr(B) 1 - B
  Matrix3T<T> B;
  for (int pair = 0; pair < 6; ++pair) {
    const auto [a, b] = kAxisPairs[pair];
    const T moment = products.y.dot(products.symmetric.segment(pair * (m_ + 1), m_ + 1));
    B(a, b) = a == b ? moment : 0.5 * moment;
    B(b, a) = B(a, b);
  }
  products.J = -B;
  products.J.diagonal().array() += B.trace();
  state.J = products.J;
  if (!coupled) return;
  // S_a = D_a y
  for (int a = 0; a < 3; ++a) state.S.row(a) = products.skew.segment(a * m_, m_).transpose();
}

template <class T>
void InertiaInvariants::set_velocity(ModalBodyStateT<T>& state) const {
  InvariantProductsT<T>& products = state.products;
  const Vector3T<T>& w = state.w_B;
  products.skew_dot.noalias() = skew_.rightCols(m_) * state.zdot;
  Eigen::Map<VectorXT<T>>(state.interface_delta_dot.data(), s_.size()).noalias() = interface_ * state.zdot;

  // h = sum_{a <= b} (w~ w~)_ab G_ab y + 2 sum_a w_a D_a z';   Q_ab = sum m_i b_a delta_b':
  // Q_ab + Q_ba = z'^T G_ab y,  (Q_yz - Q_zy, ...) = S z'
  const Matrix3T<T> w_skew = skew(w), ww = w_skew * w_skew;
  Matrix3T<T> Q;
  state.h_bias.setZero();
  for (int pair = 0; pair < 6; ++pair) {
    const auto [a, b] = kAxisPairs[pair];
    const auto Gy = products.symmetric.segment(pair * (m_ + 1) + 1, m_);
    state.h_bias += ww(a, b) * Gy;
    const T sum = state.zdot.dot(Gy);
    Q(a, b) = Q(b, a) = a == b ? sum : 0.5 * sum;
  }
  Vector3T<T> momentum;
  for (int a = 0; a < 3; ++a) {
    state.h_bias += 2.0 * w[a] * products.skew_dot.segment(a * m_, m_);
    momentum[a] = state.zdot.dot(products.skew.segment(a * m_, m_));
  }
  // t = w x (J w) + 2 sum m_i b_i x (w x delta_i') = w x (J w) + 2 (tr(Q) w - Q^T w),
  // where the skew part of Q^T w is -1/2 w x (S z')
  state.t_bias = w.cross(products.J * w) + 2.0 * (Q.trace() * w - Q * w) + w.cross(momentum);
}

double InertiaInvariants::energy_about_origin(const ModalBodyState& state) const {
  // the modal mass is the identity
  return 0.5 * state.w_B.dot(state.products.J * state.w_B) + state.w_B.dot(momentum_of_deflection(state)) +
         0.5 * state.zdot.squaredNorm();
}

Vector3 InertiaInvariants::momentum_of_deflection(const ModalBodyState& state) const {
  return state.products.skew.reshaped(m_, 3).transpose() * state.zdot;
}

template void InertiaInvariants::make_arrays(ModalBodyStateT<double>&) const;
template void InertiaInvariants::make_arrays(ModalBodyStateT<Dual>&) const;
template void InertiaInvariants::set_position(bool, ModalBodyStateT<double>&) const;
template void InertiaInvariants::set_position(bool, ModalBodyStateT<Dual>&) const;
template void InertiaInvariants::set_velocity(ModalBodyStateT<double>&) const;
template void InertiaInvariants::set_velocity(ModalBodyStateT<Dual>&) const;

}  // namespace wishbone
