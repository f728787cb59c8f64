#pragma once

#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// Modal assurance criterion of every column of A against every column of B [Allemang, Brown 1982]:
///     MAC_ij = |a_i . b_j|^2 / (|a_i|^2 |b_j|^2),
/// 1 for equal shapes of any scale. Zero for a column of zeros.
MatrixX modal_assurance(const MatrixX& A, const MatrixX& B);

/// For every row of a MAC matrix the column that it belongs to, largest values first and each column once; -1 where
/// no value of at least `least` is left. Two modes of equal frequency may be any two of their plane: with 0.4 each of
/// them still finds a partner.
std::vector<int> partners(const MatrixX& mac, double least = 0.4);

}  // namespace wishbone
