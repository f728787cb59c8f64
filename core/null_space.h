#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Orthonormal basis (n x (n - rank C)) of the null space of C (c x n). Rows of C count as dependent when less than
/// 1e-9 of the longest is left of them.
MatrixX null_space(const MatrixX& C);

}  // namespace wishbone
