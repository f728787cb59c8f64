#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Everything that depends on positions and speeds alone: kinematics, markers, closures, force elements.
void update_state(const System& system, const State& state, Workspace& ws);

/// v', lambda and the force-element rates of the closed system [theory.md 2]
///   M v' - D^T lambda = f,   D v' = gamma,
/// for the kept rows. Leaves joint forces ready for calc_joint_forces. Calls update_state.
void calc_forward_dynamics(const System& system, const State& state, Workspace& ws);

/// Forces through the inboard joints of all bodies, F_joint = P A + Z, after calc_forward_dynamics.
void calc_joint_forces(const System& system, Workspace& ws);

/// Power that prescribed motions put in, sum of joint force times V_drift [W], after calc_joint_forces.
double calc_motion_power(const System& system, double t, const Workspace& ws);

}  // namespace wishbone
