#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// What assembling found.
struct AssemblyReport {
  int position_iterations = 0;
  double position_residual = 0;  ///< largest |Phi| after projection, all rows [m, rad]
  double velocity_residual = 0;
  std::vector<int> redundant_rows;
};

/// Closure residual to which states are projected during a run [m, rad].
inline constexpr double kProjectionTolerance = 1e-12;

/// Largest iteration count of a position projection.
inline constexpr int kMaxProjections = 20;

/// Newton in the metric of kinetic energy: q <- q + M^-1 D^T lambda with D M^-1 D^T lambda = -Phi, until |Phi| <= tolerance,
/// so that the assembled pose is the nearest one and no momentum is created. Returns the number of iterations, or -1 if
/// kMaxProjections do not suffice. Far from the origin the tolerance gives way to the rounding of world positions. State velocities are only used for scratch.
int project_positions(const System& system, double tolerance, State& state, Workspace& ws);

/// v <- v + M^-1 D^T lambda with D M^-1 D^T lambda = -(D v + Phi_t): the nearest consistent speeds.
void project_velocities(const System& system, State& state, Workspace& ws);

/// Makes the initial state consistent: projects positions, finds and drops redundant closure rows, projects speeds.
/// @throws InputError naming the closure that stays open most, with its gap, when no pose near the given one satisfies all
///   of them: out of reach, or contradictory
AssemblyReport assemble(const System& system, State& state, Workspace& ws);

}  // namespace wishbone
