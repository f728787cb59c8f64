#pragma once

#include <vector>

#include "core/error.h"
#include "solver/given_speed.h"
#include "solver/workspace.h"

namespace wishbone {

/// Whether `state` has the given speeds. Needs the kinematics.
bool has_speeds(const std::vector<GivenSpeed>& given, const State& state, const Workspace& ws);

/// The speeds at the start: those nearest to state.v in the metric of kinetic energy among all with
///
///     D v = -Phi_t  (kept rows),    G v = g,
///
/// where each row of G is one given speed. Rows are taken one after the other, closures first; of U = F [D; G]^T, M^-1 = F^T F,
/// what is orthogonal to the rows before is a step Q of the answer v + F^T Q y. Of a given row that nothing is left of,
/// closures and earlier rows determine the speed: it must be the given one, up to the digits that people write (0.1 %).
/// Needs the kinematics of the state, update_closures, and factor_inertia. Changes state.v.
///
/// @param warnings takes the given speeds that differ in their last digits from what the others leave
/// @throws InputError naming the given speeds that contradict each other, or the one that the closures do not allow
void solve_given_speeds(const System& system, const std::vector<GivenSpeed>& given, State& state,
                        Workspace& ws, Warnings& warnings);

}  // namespace wishbone
