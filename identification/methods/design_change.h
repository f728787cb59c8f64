#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Where a changed structure is sought. With a complete set both give the exact result. With m < n modes and
/// no change of mass both give the same; with a change of mass they differ, and the modal space is the better
/// one, for its frequencies are upper bounds (Rayleigh-Ritz).
enum class Space { kModal, kPhysical };

/// Modes of a structure after known changes dM, dK of its mass and stiffness on existing freedoms, from its
/// modes before. As many modes as were given, of unit modal mass with respect to M + dM. Rigid-body modes of a
/// free structure must be among them. Throws InputError if M + dM is not positive definite over the modes.
///
/// In modal space, x = Psi y [2.27-2.33]:
///     (Lambda Mhat + Psi^T dK Psi) y = lambda (Mhat + Psi^T dM Psi) y.
Modes change_in_modal_space(const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                            const SparseMatrix& dK);

/// In physical space [2.15-2.26]: the eigenproblem of K* + dK* and M + dM, where with B = M Psi Mhat^-1
///     K* = B Lambda Mhat B^T,     dK* = B (Psi^T dK Psi) B^T.
/// Its n - m zero eigenvalues are left out by construction: the others have x = (M + dM)^-1 B y, so
///     (Lambda Mhat + Psi^T dK Psi) S y = lambda y,     S = B^T (M + dM)^-1 B,
/// an m x m problem; no n x n matrix is formed.
Modes change_in_physical_space(const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                               const SparseMatrix& dK);

/// The one or the other.
Modes change_structure(Space space, const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                       const SparseMatrix& dK);

}  // namespace wishbone
