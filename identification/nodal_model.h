#pragma once

#include "bodies/mode_set.h"
#include "bodies/nodal_shapes.h"

namespace wishbone {

/// The lumped model whose modes these are, from all of them (stiffness_from_modes.h):
///     K = M Psi diag(omega^2) Psi^T M,   C = M Psi diag(2 zeta omega) Psi^T M.
/// C is empty when no mode is damped.
/// @throws InputError unless the set is complete, 3n - 6 modes
NodalModel nodal_model(const ModeSet& modes);

}  // namespace wishbone
