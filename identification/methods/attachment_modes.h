#pragma once

#include <vector>

#include "identification/methods/modes.h"

namespace wishbone {

/// Static deflections of a free structure under a unit force on each of the freedoms, with inertia relief: the force
/// sets the structure into rigid motion, and what is left of it when the inertia of that motion is taken off,
///     f_e = (1 - M Psi_0 Psi_0^T) e_a,      K x = f_e,      Psi_0^T M x = 0,
/// is in equilibrium and deforms it. Columns x (n x freedoms) [m/N]. They are the attachment modes of a free body;
/// what is left of them beyond the kept normal modes, the residual attachment modes (combined_modes.h), is what these
/// modes lack of the static flexibility x = sum_j psi_j psi_ja / lambda_j.
///
/// K (n x n) is that of the free structure; `rigid` Psi_0 (n x k) are all its rigid-body motions,
/// M-orthonormal (none of a held structure, whose deflections under the forces alone these are). K is
/// factored once, on a support that holds k well placed freedoms and bears nothing, for f_e is in equilibrium; any
/// rigid motion that the support adds is taken out afterwards.
///
/// Throws InputError if a freedom is not there, if K resists rigid motion, or if it has a further motion that it does
/// not resist.
///
/// Source: R. R. Craig, A. J. Kurdila, Fundamentals of Structural Dynamics, 2nd ed. 2006, chapter 17 (inertia-relief
/// attachment modes, residual flexibility).
MatrixX attachment_modes(const SparseMatrix& K, const SparseMatrix& M, const MatrixX& rigid,
                         const std::vector<int>& freedoms);

}  // namespace wishbone
