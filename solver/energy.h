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
template <class T>
struct WorkT {
  T loss = T(0);   ///< taken by force elements (stored part included) and by structural damping
  T input = T(0);  ///< brought by applied loads and prescribed motions
};
using Work = WorkT<double>;

/// Needs update_state.
Energy calc_energy(const System& system, const State& state, const Workspace& ws);

/// Whether the power of prescribed motions needs the joint forces.
bool has_prescribed_motion(const System& system);

/// Rates of Work; with prescribed motions after calc_joint_forces or calc_motion_residual.
template <class T>
WorkT<T> calc_work_rate(const System& system, double t, const VectorXT<T>& lambda, const Evaluation<T>& ev);

}  // namespace wishbone
