#include "solver/dense_dynamics.h"

#include "solver/closure_dynamics.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"

namespace wishbone::testing {
namespace {

double kinetic_energy(const System& system, State state, const VectorX& v, Workspace& ws) {
  state.v = v;
  update_state(system, state, ws);
  return calc_energy(system, state, ws).kinetic;
}

VectorX closure_residual(const System& system, State state, const VectorX& displacement, Workspace& ws) {
  retract(system, displacement, state.q);
  update_state(system, state, ws);
  return ws.Phi;
}

}  // namespace

MatrixX mass_matrix_from_energy(const System& system, const State& state) {
  Workspace ws(system);
  const auto T = [&](const VectorX& v) { return kinetic_energy(system, state, v, ws); };
  const auto e = [&](int i) { return VectorX::Unit(system.nv, i); };
  const double T0 = T(VectorX::Zero(system.nv));
  MatrixX M(system.nv, system.nv);
  for (int i = 0; i < system.nv; ++i)
    for (int j = 0; j < system.nv; ++j) M(i, j) = T(e(i) + e(j)) - T(e(i)) - T(e(j)) + T0;
  return M;
}

MatrixX closure_jacobian_from_differences(const System& system, const State& state) {
  Workspace ws(system);
  const double h = 1e-3;
  MatrixX D(system.n_rows, system.nv);
  for (int j = 0; j < system.nv; ++j) {
    const auto Phi = [&](double s) {
      return closure_residual(system, state, s * h * VectorX::Unit(system.nv, j), ws);
    };
    // sixth order
    D.col(j) = (45 * (Phi(1) - Phi(-1)) - 9 * (Phi(2) - Phi(-2)) + (Phi(3) - Phi(-3))) / (60 * h);
  }
  return D;
}

MatrixX closure_jacobian(const System& system, const State& state) {
  Workspace ws(system);
  update_state(system, state, ws);
  MatrixX D(system.n_rows, system.nv);
  VectorX force(system.nv);
  for (int i = 0; i < system.n_rows; ++i) {
    calc_closure_force<double>(system, VectorX::Unit(system.n_rows, i), ws, force.data());
    D.row(i) = force.transpose();
  }
  return D;
}

}  // namespace wishbone::testing
