#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Rigid-body modes from geometry: an M-orthonormal basis Psi_0 (n x k, k <= 6) of the span of `shapes` (n x 6,
/// rigid_body_shapes of modal_data.h), Psi_0^T M Psi_0 = 1. Motions that move no mass, as happens where few
/// directions or nodes are listed, are left out: a chain of sliders along x has k = 1, a body k = 6.
MatrixX rigid_body_basis(const MatrixX& shapes, const SparseMatrix& M);

/// The set with the rigid-body modes (n x k, unit modal mass) before it, at lambda = 0.
Modes with_rigid_body_modes(const MatrixX& rigid, const Modes& elastic);

/// Share of each shape's modal mass that is rigid motion: |Psi_0^T M psi|^2 / (psi^T M psi), between 0 and 1.
VectorX rigid_share(const MatrixX& rigid, const MatrixX& shapes, const SparseMatrix& M);

}  // namespace wishbone
