#include "solver/workspace.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "core/dual.h"

namespace wishbone {

template <class T>
Evaluation<T>::Evaluation(const System& system)
    : bodies(system.bodies.size()),
      H(system.nv, Vector6T<T>::Zero()),
      markers(system.markers.size()),
      marker_accelerations(system.markers.size()),
      wrenches(system.markers.size()),
      element_powers(system.n_forces, T(0)),
      variables(1 + system.signals.size(), T(0)),
      x_rate(VectorXT<T>::Zero(system.nx)),
      Phi(VectorXT<T>::Zero(system.n_rows)),
      Phi_rate(VectorXT<T>::Zero(system.n_rows)),
      Phi_dd(VectorXT<T>::Zero(system.n_rows)),
      W(Matrix6XT<T>::Zero(6, system.n_columns)),
      memory{std::vector<int>(system.n_forces, 0), std::vector<double>(system.n_forces, 0.0),
             std::vector<double>(system.n_gauges, 0.0), std::vector<double>(system.measured.size(), 0.0),
             std::vector<double>(system.signals.size(), 0.0)} {
  for (const FlexibleBody& body : system.flexible) {
    const int m = body.modal.mode_count();
    flexible.push_back({body.modal.make_state<T>(), VectorXT<T>::Zero(m), VectorXT<T>::Zero(m)});
  }
}

template struct Evaluation<double>;
template struct Evaluation<Dual>;

CondensedModes::CondensedModes(const FlexibleBody& body) {
  const int m = body.modal.mode_count();
  diagonal.setOnes(m);
  if (body.carries_joints || !body.modal.set().uncoupled()) M_zz.setIdentity(m, m);
  Y.setZero(m, 6);
  P_Psi.setZero(3, m);
}

Workspace::Workspace(const System& system)
    : Evaluation<double>(system),
      articulated(system.bodies.size()),
      G(system.nv, Vector6::Zero()),
      inverse_root(VectorX::Ones(system.nv)),
      v_rate(VectorX::Zero(system.nv)),
      e(VectorX::Zero(system.nv)),
      hinge_force(VectorX::Zero(system.nv)),
      lambda(VectorX::Zero(system.n_rows)),
      displacement(VectorX::Zero(system.nv)),
      z(Matrix6X::Zero(6, 6 * static_cast<Eigen::Index>(system.bodies.size()))) {
  for (const FlexibleBody& body : system.flexible) condensed.emplace_back(body);
  keep_rows(all_rows(system), system, *this);
}

std::vector<int> all_rows(const System& system) {
  std::vector<int> rows(system.n_rows);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

std::vector<int> redundant_rows(const System& system, const std::vector<int>& kept) {
  const std::vector<int> all = all_rows(system);
  std::vector<int> redundant;
  std::set_difference(all.begin(), all.end(), kept.begin(), kept.end(), std::back_inserter(redundant));
  return redundant;
}

void keep_rows(const std::vector<int>& rows, const System& system, Workspace& ws) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  ClosureFactor& f = ws.closure;
  f.kept = rows;
  f.U = MatrixX::Zero(system.nv, n);
  f.S = MatrixX::Zero(n, n);
  f.qr = Eigen::ColPivHouseholderQR<MatrixX>(system.nv, n);
  f.scaled = MatrixX::Zero(system.nv, n);
  f.solution = f.scratch = f.lengths = VectorX::Zero(n);
  f.rank = static_cast<int>(n);
  f.orthogonal = false;
  ws.lambda.setZero();
}

}  // namespace wishbone
