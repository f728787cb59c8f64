#pragma once

#include "solver/evaluation.h"

namespace wishbone {

/// Everything that depends on positions and speeds alone: kinematics, markers, closures, force elements.
template <class T>
void update_state(const System& system, double t, const VectorXT<T>& q, const VectorXT<T>& v,
                  const VectorXT<T>& x, Evaluation<T>& ev);

/// The residual of the equations of motion, r = M(q) v' + bias(q, v) - loads - D^T lambda (size nv), by one outward and one
/// inward sweep [Featherstone 2008, ch. 5]; M is never formed. Adds the closures' forces to the loads and sets A and F_joint of
/// the bodies. Needs update_state.
template <class T>
void calc_motion_residual(const System& system, const VectorXT<T>& v_rate, const VectorXT<T>& lambda,
                          Evaluation<T>& ev, T* r);

/// D^T mu for all rows (size nv), at the state of the last update_state. Overwrites loads and joint forces.
template <class T>
void calc_closure_force(const System& system, const VectorXT<T>& mu, Evaluation<T>& ev, T* force);

}  // namespace wishbone
