#pragma once

#include <vector>

#include "identification/methods/modes.h"

namespace wishbone {

/// Kinematic joints hold a structure by rows D x = 0 (c x n).
///
/// From a complete set, axis-parallel joints: the rows and columns of the held freedoms (indices) are deleted
/// from K and M [3.10, 3.11]. Shapes have zeros there. Dense K (n x n).
Modes hold_by_joints(const MatrixX& K, const SparseMatrix& M, const std::vector<int>& held);

/// From an incomplete set of free-free modes, rigid-body modes among them: the joints bind the modal
/// coordinates, (D Psi_I) eta = 0, and the generalised eigenproblem with multipliers
///     [ Lambda  C^T ] [ eta ]          [ 1  0 ] [ eta ]
///     [ C       0   ] [ mu  ] = lambda [ 0  0 ] [ mu  ],     C = D Psi_I
/// has m - rank C finite eigenvalues [3.12-3.23]. Psi_n = Psi_I eta. Kept as the source has it; the
/// null-space form below is the same without infinite roots and costs less.
/// Throws InputError if the joints leave no mode, or a rigid-body motion free.
Modes hold_by_joints_multipliers(const Modes& free, const SparseMatrix& M, const SparseMatrix& D);

/// The same over an orthonormal basis N of the null space of C: (N^T Lambda N) y = lambda y, Psi_n = Psi_I N y.
Modes hold_by_joints_null_space(const Modes& free, const SparseMatrix& M, const SparseMatrix& D);

/// Stiffness of the free structure from its modes on joints. What is known is the stiffness against the joints'
/// ground, K_ff = M Psi Lambda Psi^T M [4.30]; the missing blocks follow from K Psi_0 = 0 [4.31-4.38]:
///     K_fc Psi_0c = -K_ff Psi_0f,     K_cc Psi_0c = -K_fc^T Psi_0f.
/// Written for joints of any direction: motion relative to the rigid motion that the joints' points follow,
///     T = 1 - Psi_0 (D Psi_0)^+ D,     K = T^T K_ff T.
/// Six joints that hold rigid motion determine K; more of them leave c - 6 of its directions without stiffness
/// (the least-squares solution of least norm). Dense n x n, symmetric, positive semidefinite.
/// Throws InputError if the joints leave a rigid-body motion free.
MatrixX stiffness_without_joints(const Modes& held, const SparseMatrix& M, const SparseMatrix& D,
                                 const MatrixX& rigid);

/// The modes of that stiffness, as many as were given, from its factors: no n x n matrix is formed. Of an incomplete
/// set they are the modes of K* with K_ff* in place of K_ff.
Modes release_from_joints(const Modes& held, const SparseMatrix& M, const SparseMatrix& D,
                          const MatrixX& rigid);

/// Number of independent rows of D over rigid motion: rank D Psi_0.
int held_rigid_freedoms(const SparseMatrix& D, const MatrixX& rigid);

}  // namespace wishbone
