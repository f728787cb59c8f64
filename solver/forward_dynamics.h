#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Everything that depends on positions and speeds alone: kinematics, markers, closures, force elements.
void update_state(const System& system, const State& state, Workspace& ws);

/// v', lambda and the force-element rates of the closed system [theory.md 2]
///   M v' - D^T lambda = f,   D v' = gamma,
/// for the kept rows. Calls update_state.
void calc_forward_dynamics(const System& system, const State& state, Workspace& ws);

/// Forces through the inboard joints of all bodies, BodyMotion::F_joint, after calc_forward_dynamics. Once only: it adds the
/// closures' forces to the loads.
void calc_joint_forces(const System& system, Workspace& ws);

/// Power that prescribed motions of tree joints put in, sum of joint force times V_drift [W], after calc_joint_forces or
/// calc_motion_residual.
template <class T>
T calc_motion_power(const System& system, double t, const Evaluation<T>& ev);

}  // namespace wishbone
