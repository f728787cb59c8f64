#pragma once

#include <vector>

#include "identification/methods/modes.h"

namespace wishbone {

/// Constraint modes [Craig and Bampton 1968]: the static deflection of the structure when one of the interface freedoms
/// moves by one and the others stand still, no force acting inside,
///     T = [1; -K_ss^-1 K_sm]     (n x freedoms, m: interface, s: all others).
/// They span every shape that the structure takes when its interfaces are moved slowly, its rigid motions `rigid`
/// (n x k) among them.
///
/// Throws InputError if a freedom is named twice or is not there, if the interface freedoms leave a rigid motion free,
/// or if K has another motion that it does not resist.
///
/// Source: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968) 1313-1319,
/// eq. (8).
MatrixX constraint_modes(const SparseMatrix& K, const MatrixX& rigid, const std::vector<int>& freedoms);

}  // namespace wishbone
