#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "solver/given_speed.h"
#include "solver/workspace.h"

namespace wishbone {

/// How far a closure is open: the norm of its rows in each unit.
struct ClosureGap {
  std::string name;
  double length = 0;  ///< [m]
  double angle = 0;   ///< [rad]
};

/// A speed that assembling changed.
struct ChangedSpeed {
  int index = 0;  ///< in v
  double given = 0, assembled = 0;
};

/// No pose near the given one closes all loops.
class OpenClosures : public InputError {
 public:
  using InputError::InputError;
};

/// What assembling found.
struct AssemblyReport {
  int position_iterations = 0;
  double position_residual = 0;  ///< largest |Phi| after projection, all rows [m, rad]
  double velocity_residual = 0;
  std::vector<ClosureGap> gaps;    ///< of each closure, in the pose that was given
  std::vector<ClosureGap> closed;  ///< what is left of them in the assembled pose
  double displacement = 0;         ///< largest change of a coordinate from that pose [m, rad]
  std::vector<int> redundant_rows;
  std::vector<ChangedSpeed> speeds;  ///< that follow from the closures and from the speeds that are given
  Warnings warnings;
};

/// Closure residual to which states are projected during a run [m, rad].
inline constexpr double kProjectionTolerance = 1e-12;

/// Next to a singular position, where the rounding of the closures grows in the rates by the inverse square of the distance.
bool near_singular(const Workspace& ws);

/// Largest iteration count of a projection.
inline constexpr int kMaxProjections = 20;

/// Newton in the metric of kinetic energy: q <- q + M^-1 D^T lambda with D M^-1 D^T lambda = -Phi, until |Phi| <= tolerance,
/// then v <- v + M^-1 D^T lambda with D M^-1 D^T lambda = -(D v + Phi_t): the nearest consistent state, so that projecting
/// creates no momentum. One factorisation serves while it converges fast. Next to a singular position the weakly closed
/// directions are left alone. Far from the origin the tolerance gives way to the rounding of world positions.
///
/// After an implicit step that is long beside the vibrations of flexible bodies, the nearest state is one that vibrates: a
/// displacement of the size of the tolerance, where the stiffness of the modes is to pull it back in the next step. With
/// `implicit_step` h [s] the metric is M + h C + h^2 K (factor_inertia), that of the step's own equations, in which the modes
/// take of the correction what they would have taken had the closures been solved along with them.
/// Returns whether the closures could be closed.
bool project(const System& system, double tolerance, State& state, Workspace& ws, double implicit_step = 0);

/// Makes the initial state consistent: finds the nearest closed pose in the metric of kinetic energy (each joint speed's
/// share times its factor in System::assembly_weights), drops redundant closure rows, keeps
/// the given speeds and changes the others least (solver/initial_speeds.h). Damped steps and the
/// nearest pose keep the branch that the given pose is on.
/// @throws OpenClosures naming the closures that stay open, with their gaps, when no pose near the given one satisfies all
///   of them: out of reach, or contradictory
/// @throws InputError naming the given speeds that contradict each other or the closures
AssemblyReport assemble(const System& system, State& state, Workspace& ws,
                        const std::vector<GivenSpeed>& given = {});

}  // namespace wishbone
