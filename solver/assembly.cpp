#include "solver/assembly.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

constexpr double kAssemblyTolerance = 1e-13;      // [m, rad]
constexpr double kContradictionTolerance = 1e-8;  // residual of a redundant row that still counts as closed
constexpr int kMaxAssemblySteps = 200;
constexpr double kMaxDamping = 1e12;

void update_closed_kinematics(const System& system, const State& state, Workspace& ws) {
  update_positions(system, state.t, state.q, ws);
  update_velocities(system, state.t, state.v, ws);
  update_markers(system, ws);
  update_closures(system, ws);
}

double largest_kept(const VectorX& r, const Workspace& ws) {
  double largest = 0;
  for (const int row : ws.kept) largest = std::max(largest, std::abs(r[row]));
  return largest;
}

/// displacement = M^-1 D^T lambda. Needs factor_inertia.
void calc_displacement(const System& system, Workspace& ws) {
  ++ws.work.projections;
  clear_loads(ws);
  add_closure_loads(system, ws.lambda, ws);
  solve_accelerations(system, Terms::loads_only, ws, ws.displacement);
}

/// displacement = -M^-1 D^T (D M^-1 D^T)^-1 r for the kept rows.
void calc_projection(const System& system, const VectorX& r, Workspace& ws) {
  factor_inertia(system, ws);
  factor_closures(system, ws);
  solve_multipliers(r, ws);
  calc_displacement(system, ws);
}

/// displacement = -M^-1 D^T (S + damping s 1)^-1 Phi with S = D M^-1 D^T of all rows and s the mean of its diagonal.
void calc_damped_projection(const System& system, double damping, Workspace& ws) {
  factor_inertia(system, ws);
  calc_closure_factor(system, ws);
  MatrixX S = ws.U.transpose() * ws.U;
  S.diagonal().array() += damping * S.diagonal().mean();
  ws.lambda = -S.ldlt().solve(ws.Phi);
  calc_displacement(system, ws);
}

/// Levenberg-Marquardt on all rows at once, redundant ones included, with damping proportional to the residual: still
/// quadratic where rows depend on each other [Yamashita & Fukushima 2001]. Which rows do can only be told at the closed
/// pose. Ends where the residual is as small as it gets; returns the number of steps.
int close_loops(const System& system, State& state, Workspace& ws) {
  update_closed_kinematics(system, state, ws);
  double residual = ws.Phi.norm();
  double caution = 1;
  int step = 0;
  for (; step < kMaxAssemblySteps && residual > kAssemblyTolerance && caution < kMaxDamping; ++step) {
    const VectorX q = state.q;
    calc_damped_projection(system, caution * residual, ws);
    retract(system, ws.displacement, state.q);
    update_closed_kinematics(system, state, ws);
    if (ws.Phi.norm() < residual) {
      residual = ws.Phi.norm();
      caution = std::max(1.0, caution / 10);
    } else {
      state.q = q;
      update_closed_kinematics(system, state, ws);
      caution *= 10;
    }
  }
  return step;
}

/// What rounding of the markers' world positions leaves of Phi, far from the origin more than any fixed tolerance.
double rounding_residual(const Workspace& ws) {
  double farthest = 0;
  for (const MarkerState& marker : ws.markers)
    farthest = std::max(farthest, marker.p_WM.cwiseAbs().maxCoeff());
  return 8 * std::numeric_limits<double>::epsilon() * farthest;
}

[[noreturn]] void fail_open(const System& system, const Workspace& ws, const std::string& why) {
  Eigen::Index worst = 0;
  ws.Phi.cwiseAbs().maxCoeff(&worst);
  throw InputError({"cut joint '" + system.row_name(static_cast<int>(worst)) + "'", why,
                    "open by " + std::to_string(ws.Phi[worst]) + " m or rad",
                    "correct the positions of the joint's two sides, or the initial joint coordinates"});
}

}  // namespace

int project_positions(const System& system, double tolerance, State& state, Workspace& ws) {
  for (int iteration = 0; iteration <= kMaxProjections; ++iteration) {
    update_closed_kinematics(system, state, ws);
    const double residual = largest_kept(ws.Phi, ws);
    if (!std::isfinite(residual)) return -1;
    if (residual <= std::max(tolerance, rounding_residual(ws))) return iteration;
    calc_projection(system, ws.Phi, ws);
    retract(system, ws.displacement, state.q);
  }
  return -1;
}

void project_velocities(const System& system, State& state, Workspace& ws) {
  update_closed_kinematics(system, state, ws);
  calc_projection(system, ws.Phi_rate, ws);
  state.v += ws.displacement;
}

AssemblyReport assemble(const System& system, State& state, Workspace& ws) {
  AssemblyReport report;
  normalize_quaternions(system, state.q);
  if (system.n_rows == 0) return report;

  std::vector<int> all(system.n_rows);
  std::iota(all.begin(), all.end(), 0);
  keep_rows(all, system, ws);
  report.position_iterations = close_loops(system, state, ws);
  if (!(ws.Phi.cwiseAbs().maxCoeff() <= kContradictionTolerance))
    fail_open(system, ws, "no pose near the given one satisfies all closures");

  factor_inertia(system, ws);
  const std::vector<int> independent = find_independent_rows(system, ws);
  std::set_difference(all.begin(), all.end(), independent.begin(), independent.end(),
                      std::back_inserter(report.redundant_rows));
  keep_rows(independent, system, ws);

  project_velocities(system, state, ws);
  update_closed_kinematics(system, state, ws);
  report.position_residual = ws.Phi.cwiseAbs().maxCoeff();
  report.velocity_residual = ws.Phi_rate.cwiseAbs().maxCoeff();
  return report;
}

}  // namespace wishbone
