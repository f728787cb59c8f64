#pragma once

#include <vector>

#include "bodies/mode_set.h"
#include "identification/elements/mesh.h"

namespace wishbone {

/// All 3n - 6 elastic modes of a free body, K psi = omega^2 M psi with M = diag(m_i 1), by a dense
/// eigenproblem.
///
/// The six rigid-body modes are constructed from geometry, not computed: with Q an orthonormal basis of the
/// complement of M^1/2 Psi_0, the eigenvectors v of Q^T M^-1/2 K M^-1/2 Q give psi = M^-1/2 Q v. So the
/// elastic modes are mass-orthonormal and orthogonal to rigid motion to rounding, with no threshold that
/// tells a rigid mode from a soft one. The sign of a mode makes its largest component positive (of several
/// equal ones, the first). Where frequencies coincide only the subspace that their modes span is determined
/// by the body.
///
/// node_ids (n), node_mass (n) [kg], node_position (3 x n) [m] in any frame: the set has them about the mass
/// centre; stiffness K (3n x 3n) symmetric [N/m]. Damping ratios are zero.
/// Throws InputError if sizes do not fit, if a mass is not positive, if K resists rigid motion (the body is
/// not free), or if K has a further motion that it does not resist (a mechanism, or a spurious zero-energy
/// mode).
ModeSet free_free_modes(const std::vector<int>& node_ids, const VectorX& node_mass,
                        const Matrix3X& node_position, const MatrixX& stiffness);

/// The same for a meshed body of one material.
ModeSet free_free_modes(const Mesh& mesh, const IsotropicMaterial& material);

}  // namespace wishbone
