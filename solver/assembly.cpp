#include "solver/assembly.h"

#include <algorithm>
#include <cmath>
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

void update_closed_kinematics(const System& system, const State& state, Workspace& ws) {
  update_positions(system, state.t, state.q, ws);
  update_velocities(system, state.t, state.q, state.v, ws);
  update_markers(system, ws);
  update_closures(system, ws);
}

double largest_kept(const VectorX& r, const Workspace& ws) {
  double largest = 0;
  for (const int row : ws.kept) largest = std::max(largest, std::abs(r[row]));
  return largest;
}

/// displacement = -M^-1 D^T (D M^-1 D^T)^-1 r.
void calc_projection(const System& system, const VectorX& r, Workspace& ws) {
  ++ws.work.projections;
  factor_inertia(system, ws);
  factor_closures(system, ws);
  solve_multipliers(r, ws);
  clear_loads(system, ws);
  add_closure_loads(system, ws.lambda, ws);
  solve_accelerations(system, Terms::loads_only, ws, ws.displacement);
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
    if (residual <= tolerance) return iteration;
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
  update_closed_kinematics(system, state, ws);
  factor_inertia(system, ws);
  const std::vector<int> independent = find_independent_rows(system, ws);
  std::set_difference(all.begin(), all.end(), independent.begin(), independent.end(),
                      std::back_inserter(report.redundant_rows));
  keep_rows(independent, system, ws);

  try {
    report.position_iterations = project_positions(system, kAssemblyTolerance, state, ws);
  } catch (const NumericsError&) {  // singular on the way: no pose was found
    report.position_iterations = -1;
  }
  if (report.position_iterations < 0) fail_open(system, ws, "the loop cannot be closed from the given pose");
  if (ws.Phi.cwiseAbs().maxCoeff() > kContradictionTolerance)
    fail_open(system, ws, "the closure contradicts the others: no pose satisfies all of them");
  project_velocities(system, state, ws);
  update_closed_kinematics(system, state, ws);
  report.position_residual = ws.Phi.cwiseAbs().maxCoeff();
  report.velocity_residual = ws.Phi_rate.cwiseAbs().maxCoeff();
  return report;
}

}  // namespace wishbone
