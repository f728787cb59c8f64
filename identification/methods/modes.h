#pragma once

#include <Eigen/Sparse>

#include "core/spatial.h"

namespace wishbone {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Modes as plain matrices, what every method of identification takes and gives.
struct Modes {
  VectorX lambda;  ///< m, omega^2, ascending [rad2/s2]
  MatrixX shapes;  ///< n x m, Psi

  Eigen::Index count() const { return lambda.size(); }
  /// [Hz]; a lambda that rounding made negative counts as zero.
  VectorX frequency_hz() const;
  Modes lowest(Eigen::Index count) const { return {lambda.head(count), shapes.leftCols(count)}; }
};

/// diag(Psi^T M Psi): the modal masses [2.7].
VectorX modal_masses(const MatrixX& shapes, const SparseMatrix& M);

/// The same modes scaled to unit modal mass. Throws InputError if a modal mass is not positive.
Modes mass_normalised(const Modes& modes, const SparseMatrix& M);

/// M = diag(m_i 1) over three freedoms a node [kg].
SparseMatrix lumped_mass_matrix(const VectorX& node_mass);

/// diag(d).
SparseMatrix diagonal_matrix(const VectorX& d);

/// Solves K x = lambda M x for symmetric dense K and M, M positive definite: modes of unit modal mass, the
/// largest component of each positive. Throws InputError if M is not positive definite.
Modes solve_eigenproblem(const MatrixX& K, const MatrixX& M);

/// The m modes at lambda != 0 of (B G B^T) x = lambda M x, for B (n x m) of full rank and symmetric G (m x m): the
/// n - m zeros are left out by construction. With x = M^-1 B y and S = B^T M^-1 B it is G S y = lambda y; no n x n
/// matrix is formed. Throws InputError if M is not positive definite or B not of full rank.
Modes solve_low_rank_eigenproblem(const MatrixX& B, const MatrixX& G, const SparseMatrix& M);

/// +1 or -1 for every column: the sign of its largest component; of components that are equal but for rounding
/// the first decides.
VectorX dominant_signs(const MatrixX& shapes);

/// Makes the largest component of every column positive.
void fix_signs(MatrixX& shapes);

}  // namespace wishbone
