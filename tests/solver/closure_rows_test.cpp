// Closure rows, their derivatives and their recursive factor against differences and dense algebra.
#include <gtest/gtest.h>

#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closures.h"
#include "solver/dense_dynamics.h"
#include "solver/forward_dynamics.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::Built;
using testing::closure_jacobian;
using testing::closure_jacobian_from_differences;
using testing::mass_matrix_from_energy;
using testing::random_loops;

constexpr unsigned kSeeds = 20;

TEST(ClosureRows, JacobianIsTheDerivativeOfTheResidual) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_loops(seed);
    const MatrixX D = closure_jacobian(m.system, m.state);
    EXPECT_LT((D - closure_jacobian_from_differences(m.system, m.state)).norm(), 1e-9 * D.norm())
        << "seed " << seed;
  }
}

/// d/dt at time 0 of a quantity of the workspace along the motion with constant v'.
template <class Quantity>
VectorX rate_along_motion(const Built& m, const VectorX& v_rate, Quantity&& quantity) {
  Workspace ws(m.system);
  const double h = 1e-2;
  const auto at = [&](double s) -> VectorX {
    State state = m.state;
    state.t += s;
    retract(m.system, s * m.state.v, state.q);
    state.v += s * v_rate;
    update_state(m.system, state, ws);
    return quantity(ws);
  };
  return (45 * (at(h) - at(-h)) - 9 * (at(2 * h) - at(-2 * h)) + (at(3 * h) - at(-3 * h))) / (60 * h);
}

TEST(ClosureRows, RatesAndAccelerationsAreDerivativesAlongTheMotion) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_loops(seed);
    Workspace ws(m.system);
    update_state(m.system, m.state, ws);
    factor_inertia(m.system, ws);
    calc_bias(m.system, Terms::all, ws);
    calc_accelerations(m.system, Terms::all, ws, ws.v_rate);
    update_closure_accelerations<double>(m.system, m.state.t, ws);
    const VectorX v_rate = ws.v_rate;
    // the difference quotient needs a motion that is smooth over its step: elastic accelerations are far too large, so
    // Phi'' is taken at the accelerations that leave the modes alone, and the modes' share added through D
    const VectorX Phi_rate =
        rate_along_motion(m, VectorX::Zero(m.system.nv), [](const auto& w) { return w.Phi; });
    const VectorX Phi_dd =
        rate_along_motion(m, VectorX::Zero(m.system.nv), [](const auto& w) { return w.Phi_rate; });
    const VectorX expected = Phi_dd + closure_jacobian(m.system, m.state) * v_rate;
    EXPECT_LT((ws.Phi_rate - Phi_rate).norm(), 1e-8 * (1 + Phi_rate.norm())) << "seed " << seed;
    EXPECT_LT((ws.Phi_dd - expected).norm(), 1e-7 * Phi_dd.norm() + 1e-10 * expected.norm())
        << "seed " << seed;
  }
}

TEST(ClosureRows, RecursiveFactorSquaresToTheInverseInertiaOfTheClosures) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_loops(seed);
    Workspace ws(m.system);
    update_state(m.system, m.state, ws);
    factor_inertia(m.system, ws);
    calc_closure_factor(m.system, ws);
    const MatrixX D = closure_jacobian(m.system, m.state);
    const MatrixX expected = D * mass_matrix_from_energy(m.system, m.state).ldlt().solve(D.transpose());
    EXPECT_LT((ws.closure.U.transpose() * ws.closure.U - expected).norm(), 1e-10 * expected.norm())
        << "seed " << seed;
  }
}

TEST(ClosureRows, MultipliersMakeTheAccelerationsConsistent) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_loops(seed);
    Workspace ws = testing::with_independent_rows(m);
    calc_forward_dynamics(m.system, m.state, ws);
    const double before = ws.Phi_dd.norm();  // of the open tree
    update_closure_accelerations<double>(m.system, m.state.t, ws);
    for (const int row : ws.closure.kept) EXPECT_NEAR(ws.Phi_dd[row], 0, 1e-10 * before) << "seed " << seed;
  }
}

}  // namespace
}  // namespace wishbone
