// The recursions against dense matrices, energies and each other, on random trees at random states.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "solver/dense_dynamics.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::Built;
using testing::mass_matrix_from_energy;
using testing::random_loops;
using testing::random_tree;

constexpr unsigned kSeeds = 20;

VectorX residual(const Built& m, const VectorX& v_rate, const VectorX& lambda) {
  Workspace ws(m.system);
  VectorX r(m.system.nv);
  update_state(m.system, m.state, ws);
  calc_motion_residual<double>(m.system, v_rate, lambda, ws, r.data());
  return r;
}

TEST(Recursions, ForwardAndInverseDynamicsAreInverseOfEachOther) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed)
    for (const Built& m : {random_tree(seed), random_loops(seed)}) {
      Workspace ws = testing::with_independent_rows(m);
      calc_forward_dynamics(m.system, m.state, ws);
      const VectorX r = residual(m, ws.v_rate, ws.lambda);
      const double scale = residual(m, VectorX::Zero(m.system.nv), ws.lambda).cwiseAbs().maxCoeff();
      EXPECT_LE(r.cwiseAbs().maxCoeff(), 1e-10 * scale) << "seed " << seed;
    }
}

TEST(Recursions, MassMatrixIsTheHessianOfKineticEnergyAndPositive) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_tree(seed);
    const int nv = m.system.nv;
    MatrixX M(nv, nv);
    const VectorX none = VectorX::Zero(0), r0 = residual(m, VectorX::Zero(nv), none);
    for (int j = 0; j < nv; ++j) M.col(j) = residual(m, VectorX::Unit(nv, j), none) - r0;
    const MatrixX expected = mass_matrix_from_energy(m.system, m.state);
    // stiff elastic forces in r0 cost digits of the difference
    const double rounding = 1e-15 * r0.cwiseAbs().maxCoeff();
    EXPECT_LT((M - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff() + 10 * rounding)
        << "seed " << seed;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixX>(expected).eigenvalues().minCoeff(), 0)
        << "seed " << seed;
  }
}

/// d/ds at s = 0, sixth-order central differences.
template <class F>
auto derivative(F&& f, double h) {
  return ((45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h)).eval();
}

/// The state a time s later when v' stays: to second order the motion itself, so first derivatives at s = 0 are exact.
State moved(const Built& m, const VectorX& v_rate, double s) {
  State state = m.state;
  state.t += s;
  retract(m.system, s * m.state.v, state.q);
  state.v += s * v_rate;
  return state;
}

TEST(Recursions, WorkOfTheForcesIsTheRateOfTheEnergies) {
  // d/dt (kinetic + gravity + elastic) = input - loss, at an instant; motions, damping, springs and loads included
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_tree(seed);
    Workspace ws(m.system);
    calc_forward_dynamics(m.system, m.state, ws);
    calc_joint_forces(m.system, ws);
    const Work rate = calc_work_rate<double>(m.system, m.state.t, ws.lambda, ws);
    const VectorX v_rate = ws.v_rate;
    const auto energy = [&](double s) {
      const State state = moved(m, v_rate, s);
      update_state(m.system, state, ws);
      const Energy e = calc_energy(m.system, state, ws);
      return Eigen::Matrix<double, 1, 1>(e.kinetic + e.gravity + e.elastic);
    };
    const double change = derivative(energy, 1e-4)[0];
    EXPECT_NEAR(change, rate.input - rate.loss, 1e-7 * energy(0)[0] + 1e-7 * std::abs(change))
        << "seed " << seed;
  }
}

TEST(Recursions, VelocitiesAndAccelerationsAreDerivativesOfPoses) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_tree(seed);
    Workspace ws(m.system), moved_ws(m.system);
    VectorX r(m.system.nv);
    const VectorX v_rate = testing::Random(seed).numbers(m.system.nv, 1);
    update_state(m.system, m.state, ws);
    calc_motion_residual<double>(m.system, v_rate, VectorX::Zero(0), ws, r.data());
    const auto at = [&](double s) -> const Workspace& {
      update_state(m.system, moved(m, v_rate, s), moved_ws);
      return moved_ws;
    };
    for (std::size_t i = 0; i < m.system.bodies.size(); ++i) {
      const BodyMotion& body = ws.bodies[i];
      const Vector3 v = derivative([&](double s) -> Vector3 { return at(s).bodies[i].X_WB.p; }, 1e-2);
      const Matrix3 R_rate = derivative([&](double s) -> Matrix3 { return at(s).bodies[i].X_WB.R; }, 1e-2);
      const Vector6 A = derivative([&](double s) -> Vector6 { return at(s).bodies[i].V; }, 1e-2);
      EXPECT_LT((v - linear(body.V)).norm(), 1e-8 * (1 + v.norm())) << "seed " << seed << ", body " << i;
      EXPECT_LT((R_rate - skew(angular(body.V)) * body.X_WB.R).norm(), 1e-8 * (1 + R_rate.norm()))
          << "seed " << seed << ", body " << i;
      EXPECT_LT((A - body.A).norm(), 1e-7 * (1 + A.norm())) << "seed " << seed << ", body " << i;
    }
    for (std::size_t i = 0; i < m.system.markers.size(); ++i) {
      const Vector3 v = derivative([&](double s) -> Vector3 { return at(s).markers[i].p_WM; }, 1e-2);
      EXPECT_LT((v - ws.markers[i].v_WM).norm(), 1e-8 * (1 + v.norm()))
          << "seed " << seed << ", marker " << i;
    }
  }
}

TEST(Recursions, RetractionFollowsTheCoordinateRates) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Built m = random_tree(seed);
    VectorX q_rate(m.system.nq);
    calc_q_rate<double>(m.system, m.state.q, m.state.v, q_rate.data());
    const VectorX numeric = derivative([&](double s) { return moved(m, m.state.v, s).q; }, 1e-2);
    EXPECT_LT((q_rate - numeric).norm(), 1e-9 * (1 + q_rate.norm())) << "seed " << seed;
  }
}

}  // namespace
}  // namespace wishbone
