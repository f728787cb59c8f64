#pragma once

#include <optional>
#include <vector>

#include "bodies/mode_set.h"
#include "identification/elements/mesh.h"

namespace wishbone {

/// How a body is spun: about a point, and held at some of its nodes, which bear what the inertia of the rest pulls.
struct SpinLoad {
  std::vector<int> held;          ///< node ids; none: the body spins freely about its mass centre
  std::optional<Vector3> centre;  ///< body axes, from the mass centre [m]; by default that of the held nodes
};

/// Geometric stiffening of the modes of a mesh by the stresses of a spin (m x 6m, ShapeSet::stiffening). The inertia of a spin
/// with angular velocity w about C loads node i with
///     f_i = -m_i w x (w x (s_i - s_C)) = -m_i sum_{a <= b} w_a w_b E_ab (s_i - s_C).
/// Each of the six loads deflects the linear body, held at the nodes given (K x_ab = f_ab), or free with the inertia of its
/// rigid motion taken off; the stresses of x_ab make the stress stiffness of every element, and K_ab = Psi^T K_sigma(x_ab) Psi.
///
/// The stresses are those of a steady spin: those of angular and linear accelerations, and of other forces on the body, are
/// not there. Source: docs/theory.md; T. R. Kane, R. R. Ryan, A. K. Banerjee, J. Guidance 10 (1987) 139-151; O. Wallrapp,
/// R. Schwertassek, Int. J. Numer. Meth. Eng. 32 (1991) 1833-1850.
/// @param set modes of the mesh, with its nodes in their order
/// @throws InputError if a node is unknown, or if the nodes do not hold the body
MatrixX spin_stiffening(const Mesh& mesh, const IsotropicMaterial& material, const ModeSet& set,
                        const SpinLoad& load);

}  // namespace wishbone
