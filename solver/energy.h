#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Energy stored now [J].
struct Energy {
  double kinetic = 0;
  double gravity = 0;  ///< -sum m g . p_WB
  double elastic = 0;  ///< of the flexible bodies
  double springs = 0;  ///< recoverable energy of the force elements
};

/// Energy that has crossed the boundary of the mechanism since the start [J].
struct Work {
  double loss = 0;   ///< taken by force elements (stored part included) and by structural damping
  double input = 0;  ///< brought by applied loads and prescribed motions
};

/// Needs update_state.
Energy calc_energy(const System& system, const State& state, const Workspace& ws);

/// Rates of Work, after calc_forward_dynamics and calc_joint_forces (or calc_motion_residual).
Work calc_work_rate(const System& system, double t, const Workspace& ws);

}  // namespace wishbone
