#pragma once

#include <optional>

#include "identification/methods/modes.h"

namespace wishbone {

/// The `count` lowest modes of K psi = lambda M psi for large sparse matrices, of unit modal mass, signs by
/// fix_signs. K (n x n) is symmetric and positive semidefinite [N/m], M symmetric with a positive diagonal,
/// lumped or consistent [kg]; both store their two triangles.
///
/// A free body is allowed: its six rigid-body modes come first, with eigenvalues that are zero but for
/// rounding (some 1e-16 of the largest eigenvalue of the model, of either sign). Who wants k elastic modes
/// asks for k + 6.
///
/// Block Lanczos iteration on (K - sigma M)^-1 M in the inner product of M, fully reorthogonalised, then a
/// Rayleigh-Ritz step on K and M themselves. What is returned has passed two checks:
///   - || (K - sigma M)^-1 (K psi - lambda M psi) ||_M <= 1e-7, which bounds the relative error of
///     lambda - sigma;
///   - Sylvester's law of inertia: K - mu M, with mu in the last clear gap between the eigenvalues found, has
///     as many negative pivots as there are eigenvalues found below mu. So none is missing, repeated ones
///     included.
///
/// `shift` sigma [rad2/s2] must make K - sigma M positive definite: below the lowest eigenvalue, negative for
/// a free body. Without it, -1e-7 of the median of K_ii / M_ii is taken, clear of rounding and below the
/// elastic modes of most meshes. Equal input gives equal bits.
///
/// Memory: two bases of some 3 count columns, the factor of K - sigma M, and nothing dense of n x n unless
/// most modes are wanted (n < 3 count + 100: then a dense eigenproblem is solved).
///
/// Throws InputError if sizes do not fit, if count is not in 1..n, if a number is not finite, if a matrix is
/// not symmetric, if a freedom has no mass or if K - sigma M is not positive definite; NumericsError if the
/// iteration does not converge or misses a mode.
///
/// Source: R. G. Grimes, J. G. Lewis, H. D. Simon, A shifted block Lanczos algorithm for solving sparse
/// symmetric generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994) 228-272.
Modes lowest_modes(const SparseMatrix& K, const SparseMatrix& M, int count,
                   std::optional<double> shift = std::nullopt);

}  // namespace wishbone
