#pragma once

#include <string>

#include "identification/methods/modes.h"

namespace wishbone {

/// The largest products of different modes in a mass matrix, |psi_i^T M psi_j| / sqrt(psi_i^T M psi_i psi_j^T M psi_j),
/// in words: "0.31 (modes 2 and 5), 0.12 (modes 3 and 7)". At most `count` of them, none below 0.001.
std::string largest_mass_products(const MatrixX& shapes, const SparseMatrix& M, std::size_t count = 4);

}  // namespace wishbone
