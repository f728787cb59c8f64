#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// How many modes of K psi = lambda M psi lie below `lambda` [rad2/s2], rigid-body modes among them: K - lambda M has
/// as many negative pivots (Sylvester's law of inertia). One sparse factorisation, no mode is computed. K and M
/// (n x n) are symmetric, M positive definite. A mode that lies on the limit but for rounding may count or not.
/// Throws NumericsError if no factorisation is found about the limit.
Eigen::Index modes_below(const SparseMatrix& K, const SparseMatrix& M, double lambda);

}  // namespace wishbone
