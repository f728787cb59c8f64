#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Bound on |lambda - lambda_true| / lambda of approximate modes of unit modal mass [Krylov, Weinstein]: some
/// eigenvalue of the structure lies within
///     |K x - lambda M x| in the metric of M^-1
/// of each lambda. `K_shapes` = K Psi must be known without the approximation. On joints D x = 0 their reactions
/// D^T mu carry what they can: the least residual over mu counts.
VectorX relative_residuals(const Modes& modes, const MatrixX& K_shapes, const SparseMatrix& M,
                           const SparseMatrix& D);

/// Estimate of f / f_true - 1 of Rayleigh-Ritz modes, to second order in their residuals rho (relative_residuals): what
/// is missing from a shape lies in the motions left out, which are as stiff as the stiffest mode kept or stiffer, so
/// that [Kato 1949]
///     (lambda - lambda_true) / lambda <~ rho^2 lambda / (lambda_kept - lambda),
/// and no more than the bound rho itself. Half of it is that of the frequency. NaN where there is no residual.
VectorX frequency_error_estimate(const VectorX& lambda, const VectorX& residual, double lambda_kept);

}  // namespace wishbone
