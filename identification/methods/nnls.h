#pragma once

#include "core/spatial.h"

namespace wishbone {

/// min |A x - b| over x >= 0 by the active-set method of Lawson and Hanson, Solving Least Squares Problems, 1974,
/// chapter 23. Throws NumericsError if it does not end within 3 n exchanges (it always has in exact arithmetic).
VectorX nonnegative_least_squares(const MatrixX& A, const VectorX& b);

}  // namespace wishbone
