#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// What holds a structure, as matrices over its n freedoms.
struct SupportMatrices {
  SparseMatrix K_s;  ///< n x n, springs [N/m]
  SparseMatrix M_s;  ///< n x n, masses that move with the structure but are not of it [kg]
  SparseMatrix D;    ///< c x n, joints: D x = 0
};

/// Number of independent rigid-body motions (columns of Psi_0) that springs or joints resist.
int held_motions(const SupportMatrices& support, const MatrixX& rigid);

/// Combinations of the rigid-body motions (n x k) that neither springs nor joints resist; no columns where there are none.
MatrixX unheld_motions(const SupportMatrices& support, const MatrixX& rigid);

/// Free-free elastic modes of a structure that was measured on a support.
struct ReleasedModes {
  Modes modes;           ///< unit modal mass, orthogonal to rigid motion
  MatrixX coefficients;  ///< m x k, how the given modes combine: x = (1 - Psi_0 Psi_0^T M) Psi C
  MatrixX K_shapes;      ///< n x k, K x of the free structure, known without approximation
  VectorX residual;    ///< k, bound on |lambda - lambda_true| / lambda; NaN where reactions are indeterminate
  int lost_modes = 0;  ///< elastic modes that no measurement on this support can show
};

/// Rayleigh-Ritz over the given modes and the exact rigid-body modes Psi_0 of the free structure. Two things are
/// known of its stiffness without error: what it does on the kept set and on rigid motion,
///     K psi = lambda M_t psi - K_s psi + D^T mu,       K Psi_0 = 0,
/// with mu the reactions of the joints, which follow from equilibrium, Psi_0^T K psi = 0. So in the part of the
/// set that is M-orthogonal to Psi_0,
///     X = (1 - Psi_0 Psi_0^T M) Psi,   (X^T K X) y = lambda (X^T M X) y,   X^T K X = Lambda - Psi^T K_s Psi,
/// gives upper bounds of the free-free frequencies and, complete, the free-free frequencies themselves. It is the
/// modal-space method [4.6-4.14] on springs and the recovery of the missing blocks [4.30-4.38] on joints, cleaned
/// up in the same step: nothing has to tell a rigid mode from a soft one, and no n x n matrix is formed.
///
/// A given mode that is nearly rigid brings in little but its errors: directions of the set whose elastic share
/// of modal mass is below `least_elastic_share` are left out. Of the rest as many modes are returned as the set
/// can be expected to carry: m less the rigid motions that springs turned into modes, and of an incomplete set none
/// that lie 5 % above the highest measured frequency with a large residual.
///
/// The bound is that of Krylov and Weinstein, |K x - lambda M x| in the metric of M^-1.
/// `supported`: modes of unit modal mass in M + M_s, D Psi = 0; `M`: of the free structure; `rigid`: Psi_0,
/// M-orthonormal (rigid_body_basis).
/// Throws InputError if there are joints and the support leaves a rigid motion free, or if too few modes are
/// given.
ReleasedModes release(const Modes& supported, const SparseMatrix& M, const SupportMatrices& support,
                      const MatrixX& rigid, double least_elastic_share = 1e-6);

}  // namespace wishbone
