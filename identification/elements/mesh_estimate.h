#pragma once

#include "identification/elements/mesh.h"

namespace wishbone {

/// What a mesh makes of its modes, estimated element by element: the ratio omega / omega* of each (m) of the frequency that it
/// has on the mesh, with masses at the nodes, to that of the same motion in elements that bend and have mass where they are,
///     omega^2 = sum u^T K_e u / sum m_a |u_a|^2        omega*^2 = sum u^T K*_e u / sum int |u(x)|^2 dV,
/// K* the stiffness with incompatible modes where the mesh has mean dilatation, u(x) the displacement inside, which bulges by
/// these modes. Shear locking shows by a ratio above 1, motions that cost too little by one below it, too few elements in a wave
/// by masses that are not where the motion is. Of large meshes some elements are asked, evenly spread.
/// @param shapes 3n x m, displacements of the nodes, stacked as in `stiffness_matrix`
VectorX frequency_ratios(const Mesh& mesh, const IsotropicMaterial& material, const MatrixX& shapes);

}  // namespace wishbone
