#pragma once

#include <optional>

#include "identification/methods/released_modes.h"

namespace wishbone {

/// Modes of a model on a support, rigid-body motion at lambda = 0 included when it is free:
///     (K + K_s) x = lambda (M + M_s) x,   D x = 0,
/// over an orthonormal basis of the null space of D. `count`: lowest modes, all by default; a few modes of a large
/// model come from lowest_modes (lowest_modes.h), all others from a dense eigenproblem.
/// Throws InputError if M + M_s is not positive definite, or if all modes of more than kMostDenseFreedoms freedoms are
/// wanted.
Modes model_modes(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                  std::optional<Eigen::Index> count = {});

/// How many of them lie below `lambda` [rad2/s2] (modes_below.h).
Eigen::Index model_modes_below(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                               double lambda);

inline constexpr Eigen::Index kMostDenseFreedoms = 6000;

}  // namespace wishbone
