#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Modal assurance criterion of every column of A against every column of B [Allemang, Brown 1982]:
///     MAC_ij = |a_i . b_j|^2 / (|a_i|^2 |b_j|^2),
/// 1 for equal shapes of any scale. Zero for a column of zeros.
MatrixX modal_assurance(const MatrixX& A, const MatrixX& B);

}  // namespace wishbone
