#pragma once

#include <optional>

#include "identification/methods/released_modes.h"

namespace wishbone {

/// Modes of a model on a support, rigid-body motion at lambda = 0 included when it is free:
///     (K + K_s) x = lambda (M + M_s) x,   D x = 0.
/// Dense, over an orthonormal basis of the null space of D. `count`: lowest modes, all by default.
/// Throws InputError if M + M_s is not positive definite, or if the model has more than kMostDenseFreedoms.
Modes model_modes(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                  std::optional<Eigen::Index> count = {});

inline constexpr Eigen::Index kMostDenseFreedoms = 6000;

}  // namespace wishbone
