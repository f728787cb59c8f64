#pragma once

#include <optional>

#include "identification/methods/modes.h"

namespace wishbone {

/// The nodal masses m_i [kg] that a mass matrix over three freedoms a node stands for when it is lumped,
/// M = diag(m_i 1), up to 1e-9 of its largest entry; nothing when it is not. Throws InputError if its size is no
/// multiple of three.
std::optional<VectorX> nodal_masses(const SparseMatrix& M);

/// How a mass matrix is lumped.
enum class Lumping {
  row_sum,  ///< m_i = sum_j M_ij: keeps mass, mass centre and first moments; may turn negative on quadratic elements
  diagonal  ///< m_i = M_ii (sum_jk M_jk) / (sum_j M_jj): keeps the mass and its sign; centre and inertia shift a little
};

/// Nodal masses (n) [kg] from a consistent mass matrix (3n x 3n), for each direction the sums over freedoms of that
/// direction. Throws InputError if a mass does not come out positive, or if x, y and z of a node come out different.
/// Source: E. Hinton, T. Rock, O. C. Zienkiewicz, A note on mass lumping and related processes in the finite element
/// method, Earthquake Eng. Struct. Dyn. 4 (1976) 245-249.
VectorX lumped_masses(const SparseMatrix& M, Lumping lumping);

}  // namespace wishbone
