#pragma once

#include <vector>

#include "bodies/interface_frame.h"
#include "bodies/shape_set.h"

namespace wishbone {

/// The body with frames whose nodes keep their distances (in finite element programs: rigid elements, RBE2): each
/// node of a frame moves as the frame does,
///     delta_i = u + phi x r_i,     R z = 0,     R_i = Phi_i - Phi_u + r_i~ Phi_phi   (3 x m for each node),
/// with u = Phi_u z and phi = Phi_phi z of the frame (FrameShapes), whatever its weights. What is left of the
/// shapes is Phi N, N an orthonormal basis of the null space of R (core/null_space.h), with
///     K <- N^T K N,     C <- N^T C N.
/// Mass-orthonormal shapes stay so, and the reference condition holds of them as before. Where the shapes were
/// modes (K diagonal) they are made modes again, ascending: with the singular values omega and right vectors V of
/// K^1/2 N,
///     shapes Phi N V,     K = diag(omega^2),     C = V^T N^T C N V,
/// which is exact to the lowest of them. C is kept as a matrix unless V makes it diagonal, as it does of C = alpha
/// 1 + beta K.
///
/// The kinematics is linear, as small strains are. The motion is Ritz's in what the shapes are able to do: exact
/// when they are complete, or when they have the static shapes of forces at the nodes of the frames and the loads
/// are slow.
///
/// @returns the set as it is without frames
/// @throws InputError as frame_shapes does, and if no shape is left
ShapeSet with_rigid_frames(const ShapeSet& set, const std::vector<InterfaceFrame>& frames);

}  // namespace wishbone
