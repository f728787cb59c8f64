#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// The residual of the equations of motion, r = M(q) v' + bias(q, v) - loads - D^T lambda (size nv), by one outward and one
/// inward sweep [Featherstone 2008, ch. 5]; M is never formed. Sets BodyState::F_joint. Calls update_state.
void calc_motion_residual(const System& system, const State& state, const VectorX& v_rate,
                          const VectorX& lambda, Workspace& ws, Eigen::Ref<VectorX> r);

/// D^T mu for all rows (size nv), at the state of the last update_state.
void calc_closure_force(const System& system, const VectorX& mu, Workspace& ws, Eigen::Ref<VectorX> force);

}  // namespace wishbone
