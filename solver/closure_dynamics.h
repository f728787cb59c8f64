#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// A row counts as dependent on those before it when the sine of its angle to them, in the metric of kinetic energy, is
/// below such a tolerance. Multipliers are solved for as long as rounding leaves them a digit; a projection is left out
/// along directions that are weakly closed (the mechanism is next to a singular position), where it would amplify rounding
/// by the inverse square of the sine.
inline constexpr double kDynamicsRankTolerance = 1e-13;
inline constexpr double kProjectionRankTolerance = 1e-4;

/// The factor U of the closures' inverse inertia, D M^-1 D^T = U^T U, for the kept rows. U comes from inward sweeps
/// alone [Rodriguez, Jain & Kreutz-Delgado 1991]: with M^-1 = (1 - H psi K)^T D^-1 (1 - H psi K), column i of U is what
/// the unit wrenches of row i leave in the hinges on their way to the root. Needs factor_inertia, update_closures.
void calc_closure_factor(const System& system, Workspace& ws);

/// Factors D M^-1 D^T of the kept rows: by Cholesky, or by QR of U with column pivoting where rows are close to dependent
/// (Cholesky of U^T U would square the condition); rows whose sine is below the tolerance are then left out.
void factor_closures(const System& system, double rank_tolerance, Workspace& ws);

/// Whether a kept row (by its place among them) takes part in the last factorisation.
bool takes_part(const ClosureFactor& factor, int i);

/// Solves D M^-1 D^T lambda = -r for the rows that take part; lambda of the others is zero. M^-1 D^T lambda follows from
/// e = U ClosureFactor::solution and calc_accelerations.
void solve_multipliers(const VectorX& r, Workspace& ws);

}  // namespace wishbone
