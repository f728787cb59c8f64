#pragma once

#include <vector>

#include "identification/methods/modes.h"

namespace wishbone {

/// Shapes over all freedoms of a model from shapes over some of them (`measured`: their rows in the model), as the
/// combination of model modes that fits best (SEREP) [O'Callahan, Avitabile, Riemer 1989]:
///     Psi = Phi Phi_m^+ Psi_m.
/// Exact when the modes lie in the span of the model's. Throws InputError if the measured freedoms cannot tell the
/// model modes (n x p) apart.
MatrixX expand_serep(const MatrixX& model_shapes, const std::vector<int>& measured, const MatrixX& shapes);

/// How many of the model's modes the measured freedoms can tell apart.
Eigen::Index serep_rank(const MatrixX& model_shapes, const std::vector<int>& measured);

/// Displacements of all freedoms (n x r) when the `masters` move by one each and no force acts on the others
/// [Guyan 1965]:
///     T = [1; -K_ss^-1 K_sm].
/// Shapes expand statically as T Psi_m, matrices reduce as T^T K T, T^T M T. Throws InputError if the masters do not
/// hold the structure (K_ss singular).
MatrixX static_transformation(const SparseMatrix& K, const std::vector<int>& masters);

/// The same of a structure on joints D x = 0 (c x n), which also hold freedoms that are no masters:
///     min x^T K x,   x_masters given,   D x = 0.
MatrixX static_transformation(const SparseMatrix& K, const SparseMatrix& D, const std::vector<int>& masters);

/// T^T A T, symmetric (r x r).
MatrixX reduced(const SparseMatrix& A, const MatrixX& T);

}  // namespace wishbone
