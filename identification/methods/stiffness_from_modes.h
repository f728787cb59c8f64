#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Stiffness matrix that a set of modes stands for,
///     K = sum_i (lambda_i / mhat_i) (M psi_i)(M psi_i)^T,     mhat_i = psi_i^T M psi_i
/// [2.11]. With all n modes it is the stiffness of the structure; with m < n kept ones it is K*, of rank m at
/// most, and what is missing from K is the share K_d of the modes left out [2.12, 2.14]. Dense n x n [N/m].
MatrixX stiffness_from_modes(const Modes& modes, const SparseMatrix& M);

}  // namespace wishbone
