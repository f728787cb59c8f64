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

}  // namespace wishbone
