#include "solver/assembly.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closure_rank.h"
#include "solver/closures.h"
#include "solver/initial_speeds.h"
#include "solver/kinematics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

constexpr double kAssemblyTolerance = 1e-13;      // [m, rad]
constexpr double kContradictionTolerance = 1e-8;  // residual of a redundant row that still counts as closed
constexpr int kMaxAssemblySteps = 200;
constexpr double kMaxDamping = 1e12;
constexpr double kNearSingular = 0.02;    // least sine of the closure rows
constexpr double kFastConvergence = 0.1;  // of residuals, below which a factor serves again

void update_closed_kinematics(const System& system, const State& state, Workspace& ws) {
  ++ws.work.position;
  ++ws.work.velocity;
  update_positions<double>(system, state.t, state.q, ws);
  update_velocities<double>(system, state.t, state.q, state.v, ws);
  update_markers<double>(system, ws);
  update_closures<double>(system, state.t, ws);
}

double largest_kept(const VectorX& r, bool factored, const Workspace& ws) {
  const ClosureFactor& f = ws.closure;
  double largest = 0;
  for (std::size_t i = 0; i < f.kept.size(); ++i)
    if (!factored || takes_part(f, static_cast<int>(i))) largest = std::max(largest, std::abs(r[f.kept[i]]));
  return largest;
}

/// displacement = M^-1 D^T lambda, lambda the multipliers of the kept rows. Needs the factors.
void calc_correction(const System& system, const VectorX& lambda, Workspace& ws) {
  ++ws.work.projections;
  ws.e.noalias() = ws.closure.U * lambda;
  calc_accelerations(system, Terms::hinge_forces, ws, ws.displacement);
}

void factor(const System& system, Workspace& ws, double implicit_step = 0) {
  factor_inertia(system, ws, implicit_step);
  factor_closures(system, kProjectionRankTolerance, ws);
}

/// displacement = -M^-1 D^T (D M^-1 D^T)^-1 r for the kept rows, with the factors at hand.
void calc_projection(const System& system, const VectorX& r, Workspace& ws) {
  solve_multipliers(r, ws);
  calc_correction(system, ws.closure.solution, ws);
}

/// displacement = -M^-1 D^T (S + damping s 1)^-1 Phi with S = D M^-1 D^T of all rows and s the mean of its diagonal.
void calc_damped_projection(const System& system, double damping, Workspace& ws) {
  factor_inertia(system, ws);
  calc_closure_factor(system, ws);
  MatrixX S = ws.closure.U.transpose() * ws.closure.U;
  S.diagonal().array() += damping * S.diagonal().mean();
  calc_correction(system, -S.ldlt().solve(ws.Phi), ws);
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

/// What rounding of the markers' world positions leaves of Phi, far from the origin more than any fixed tolerance. Next to
/// a singular position the last bit counts.
double rounding_residual(const Workspace& ws) {
  double farthest = 0;
  for (const MarkerState& marker : ws.markers)
    farthest = std::max(farthest, marker.p_WM.cwiseAbs().maxCoeff());
  return (near_singular(ws) ? 0.5 : 8) * std::numeric_limits<double>::epsilon() * farthest;
}

/// The same for Phi'.
double rounding_rate(const Workspace& ws) {
  double fastest = 0;
  for (const MarkerState& marker : ws.markers)
    fastest = std::max({fastest, marker.v_WM.cwiseAbs().maxCoeff(), marker.w_WM.cwiseAbs().maxCoeff()});
  return (near_singular(ws) ? 1 : 32) * std::numeric_limits<double>::epsilon() * fastest;
}

bool project_positions(const System& system, double tolerance, double implicit_step, bool& factored,
                       State& state, Workspace& ws) {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration <= kMaxProjections; ++iteration) {
    update_closed_kinematics(system, state, ws);
    const double residual = largest_kept(ws.Phi, factored, ws);
    if (!std::isfinite(residual)) return false;
    // one correction takes the residual to rounding; stopping short of it would leave noise that does not shrink with the
    // step and that multistep formulas amplify
    if (residual <= rounding_residual(ws)) return true;
    if (iteration > 0 && residual <= tolerance && (!near_singular(ws) || residual >= 0.5 * last)) return true;
    if (!factored || residual > kFastConvergence * last) factor(system, ws, implicit_step);
    factored = true;
    last = residual;
    calc_projection(system, ws.Phi, ws);
    retract(system, ws.displacement, state.q);
  }
  return false;
}

void project_velocities(const System& system, double implicit_step, bool& factored, State& state,
                        Workspace& ws) {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration <= kMaxProjections; ++iteration) {
    if (iteration > 0) update_closed_kinematics(system, state, ws);
    const double residual = largest_kept(ws.Phi_rate, factored, ws);
    if (residual <= rounding_rate(ws) || !(residual < last)) return;
    if (!factored || residual > kFastConvergence * last) factor(system, ws, implicit_step);
    factored = true;
    last = residual;
    calc_projection(system, ws.Phi_rate, ws);
    state.v += ws.displacement;
  }
}

/// Whether a trial pose could be closed, weakly closed rows included. Undamped, a projection may run off to where the inertia
/// has no digits left, or to where the coordinates of a joint end.
bool close_trial(const System& system, State& state, Workspace& ws) {
  bool factored = false;
  try {
    return project_positions(system, kProjectionTolerance, 0, factored, state, ws) &&
           ws.Phi.cwiseAbs().maxCoeff() <= kContradictionTolerance;
  } catch (const NumericsError&) {
    return false;
  }
}

/// What the closures leave of the displacement from q0 to a closed pose, in the metric of kinetic energy: nothing at the
/// nearest one. Overwrites the speeds.
VectorX tangential_displacement(const System& system, const VectorX& q0, State& pose, Workspace& ws) {
  // taken as speeds, D d = 0; driven rows at rest
  pose.v.setZero();
  update_closed_kinematics(system, pose, ws);
  const VectorX drift = ws.Phi_rate;
  calc_displacement(system, q0, pose.q, pose.v);
  update_closed_kinematics(system, pose, ws);
  factor(system, ws);
  calc_projection(system, ws.Phi_rate - drift, ws);
  return pose.v + ws.displacement;
}

/// Moves along the closed poses to the one nearest to q0 in the metric of kinetic energy, down the gradient of the distance,
/// which is the tangential displacement g. How far is told by its change over the step before [Barzilai & Borwein 1988], and
/// by g having to shrink: where the closed poses curve more than q0 is away from them, a whole step leads off.
void approach(const System& system, const VectorX& q0, State& state, Workspace& ws) {
  constexpr int kMaxTrials = 100;
  constexpr double kNear = 1e-10, kLeastStep = 1e-6;
  State probe = state;
  VectorX g = tangential_displacement(system, q0, probe, ws);
  double step = 1;
  for (int trial = 0; trial < kMaxTrials && step > kLeastStep && g.cwiseAbs().maxCoeff() > kNear; ++trial) {
    probe.q = state.q;
    retract(system, -step * g, probe.q);
    const bool closed = close_trial(system, probe, ws);
    const VectorX next = closed ? tangential_displacement(system, q0, probe, ws) : g;
    if (!(next.norm() < g.norm())) {
      step /= 4;
      continue;
    }
    state.q = probe.q;
    step *= g.squaredNorm() / g.dot(g - next);
    g = next;
  }
}

/// Speeds that closures and given speeds allow: the nearest ones, and where that would change given speeds, the nearest among
/// those that keep them. Needs the kinematics.
void assemble_speeds(const System& system, const std::vector<GivenSpeed>& given, State& state, Workspace& ws,
                     AssemblyReport& report) {
  const VectorX v0 = state.v;
  bool factored = false;
  project_velocities(system, 0, factored, state, ws);
  update_closed_kinematics(system, state, ws);
  if (!has_speeds(given, state, ws)) {
    state.v = v0;
    update_closed_kinematics(system, state, ws);
    factor_inertia(system, ws);
    solve_given_speeds(system, given, state, ws, report.warnings);
    update_closed_kinematics(system, state, ws);
    project_velocities(system, 0, factored, state, ws);
  }
  const double rounding = 1e-9 * (state.v.size() > 0 ? state.v.cwiseAbs().maxCoeff() : 0.0);
  for (int i = 0; i < system.nv; ++i)
    if (std::abs(state.v[i] - v0[i]) > rounding) report.speeds.push_back({i, v0[i], state.v[i]});
}

std::vector<ClosureGap> closure_gaps(const System& system, const Workspace& ws) {
  std::vector<ClosureGap> gaps;
  for (const Closure& closure : system.closures) {
    ClosureGap gap{closure.name};
    for (int i = 0; i < closure.rows; ++i) {
      double& open = row_is_angle(closure.joint, i) ? gap.angle : gap.length;
      open = std::hypot(open, ws.Phi[closure.row_start + i]);
    }
    gaps.push_back(gap);
  }
  return gaps;
}

[[noreturn]] void fail_open(const System& system, const Workspace& ws) {
  std::vector<ClosureGap> gaps = closure_gaps(system, ws);
  const auto size = [](const ClosureGap& g) { return std::max(g.length, g.angle); };
  std::sort(gaps.begin(), gaps.end(),
            [&](const ClosureGap& a, const ClosureGap& b) { return size(a) > size(b); });
  constexpr std::size_t kNamed = 4;
  std::string open;
  for (std::size_t i = 0; i < std::min(gaps.size(), kNamed) && size(gaps[i]) > kContradictionTolerance; ++i) {
    open += fmt::format("{}'{}' by", i > 0 ? "; " : "", gaps[i].name);
    if (gaps[i].length > kContradictionTolerance) open += fmt::format(" {:.6g} m", gaps[i].length);
    if (gaps[i].angle > kContradictionTolerance) open += fmt::format(" {:.6g} rad", gaps[i].angle);
  }
  Eigen::Index worst = 0;
  ws.Phi.cwiseAbs().maxCoeff(&worst);
  throw OpenClosures({"cut joint '" + system.row_name(static_cast<int>(worst)) + "'",
                      "no pose near the given one satisfies all closures", "open: " + open,
                      "correct the positions of the joint's two sides, or the initial joint coordinates"});
}

}  // namespace

bool near_singular(const Workspace& ws) {
  return ws.closure.least_sine < kNearSingular;
}

bool project(const System& system, double tolerance, State& state, Workspace& ws, double implicit_step) {
  bool factored = false;
  if (!project_positions(system, tolerance, implicit_step, factored, state, ws)) return false;
  project_velocities(system, implicit_step, factored, state, ws);
  return true;
}

AssemblyReport assemble(const System& system, State& state, Workspace& ws,
                        const std::vector<GivenSpeed>& given) {
  AssemblyReport report;
  normalize_quaternions(system, state.q);
  update_closed_kinematics(system, state, ws);
  remember_angles(system, state, ws);
  if (system.n_rows == 0) {
    assemble_speeds(system, given, state, ws, report);
    return report;
  }
  const VectorX q0 = state.q;
  ws.stiffening = system.assembly_weights;
  keep_rows(all_rows(system), system, ws);
  report.gaps = closure_gaps(system, ws);
  report.position_iterations = close_loops(system, state, ws);
  if (!(ws.Phi.cwiseAbs().maxCoeff() <= kContradictionTolerance)) fail_open(system, ws);

  factor_inertia(system, ws);
  const std::vector<int> independent = find_independent_rows(system, ws);
  report.redundant_rows = redundant_rows(system, independent);
  keep_rows(independent, system, ws);
  if (report.position_iterations > 1) approach(system, q0, state, ws);

  update_closed_kinematics(system, state, ws);
  assemble_speeds(system, given, state, ws, report);
  ws.stiffening.resize(0);
  update_closed_kinematics(system, state, ws);
  remember_angles(system, state, ws);
  VectorX d = VectorX::Zero(system.nv);
  calc_displacement(system, q0, state.q, d);
  report.displacement = d.size() > 0 ? d.cwiseAbs().maxCoeff() : 0.0;
  report.closed = closure_gaps(system, ws);
  report.position_residual = ws.Phi.cwiseAbs().maxCoeff();
  report.velocity_residual = ws.Phi_rate.cwiseAbs().maxCoeff();
  return report;
}

}  // namespace wishbone
