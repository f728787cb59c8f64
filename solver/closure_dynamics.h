#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Phi, the unit wrenches W_A, W_B (the columns of D^T) and Phi' = D v + Phi_t of all closure rows. Needs update_markers.
void update_closures(const System& system, Workspace& ws);

/// Second rates of all rows for the accelerations now in the workspace (solve_accelerations).
void update_closure_accelerations(const System& system, Workspace& ws);

/// The factor U of the closures' inverse inertia, D M^-1 D^T = U^T U, for the kept rows. U comes from inward sweeps
/// alone [Rodriguez, Jain & Kreutz-Delgado 1991]: with M^-1 = (1 - H psi K)^T D^-1 (1 - H psi K), column i of U is what
/// the unit wrenches of row i leave in the hinges on their way to the root. Needs factor_inertia, update_closures.
void calc_closure_factor(const System& system, Workspace& ws);

/// Factors D M^-1 D^T of the kept rows.
/// @throws NumericsError naming the closure when a kept row has become dependent.
void factor_closures(const System& system, Workspace& ws);

/// Solves D M^-1 D^T lambda = -r for the kept rows of r; lambda of the others is zero.
void solve_multipliers(const VectorX& r, Workspace& ws);

/// Rows of an independent subset, by orthogonalising the columns of U one after the other, that is the rows of D in the
/// metric of kinetic energy (so that metres and radians compare). Call with all rows kept. Earlier rows are preferred.
std::vector<int> find_independent_rows(const System& system, Workspace& ws);

}  // namespace wishbone
