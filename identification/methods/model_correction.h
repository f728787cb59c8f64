#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Mass and stiffness matrix of a model after its correction.
struct CorrectedModel {
  MatrixX M;  ///< n x n [kg]
  MatrixX K;  ///< n x n [N/m]
};

/// Analytical matrices M_a, K_a changed as little as possible so that they have the measured modes (figure 1.2 of
/// the source). The mass takes the smallest change that makes the measured shapes orthonormal [Berman, Nagy 1983],
/// with m_a = Phi^T M_a Phi:
///     M = M_a + M_a Phi m_a^-1 (1 - m_a) m_a^-1 Phi^T M_a,
/// and the stiffness the smallest one that makes them modes at the measured frequencies [Baruch 1978]:
///     K = K_a - K_a Phi Phi^T M - M Phi Phi^T K_a + M Phi (Phi^T K_a Phi + Lambda) Phi^T M.
/// K Phi = M Phi Lambda and Phi^T M Phi = 1 hold exactly; modes of the model that are M-orthogonal to Phi stay as
/// they are. Pass measured modes through cleaned_up() first: then the mass does not change, and rigid motion that K_a
/// does not resist stays unresisted. Dense n x n.
/// Throws InputError if the shapes are linearly dependent.
CorrectedModel correct_model(const SparseMatrix& M_a, const SparseMatrix& K_a, const Modes& measured);

}  // namespace wishbone
