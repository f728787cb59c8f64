#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Measured modes made to obey what is certain. Rigid motion Psi_0 (n x k, M-orthonormal, from geometry; may have
/// no columns) is taken out, Psi <- (1 - Psi_0 Psi_0^T M) Psi, and the rest is mass-orthonormalised by the
/// symmetric root, which among all orthonormal sets is the nearest to the measured one [Baruch 1978]:
///     Psi <- Psi (Psi^T M Psi)^-1/2.
/// Each mode is scaled to unit modal mass before. Frequencies stay as measured.
/// Throws InputError if a mode is nothing but rigid motion, or if the modes are linearly dependent.
Modes cleaned_up(const Modes& modes, const SparseMatrix& M, const MatrixX& rigid);

/// Largest off-diagonal element of Psi^T M Psi of modes scaled to unit modal mass.
double orthogonality_error(const MatrixX& shapes, const SparseMatrix& M);

}  // namespace wishbone
