#pragma once

#include <vector>

#include "identification/methods/released_modes.h"
#include "identification/modal_data.h"

namespace wishbone {

/// The springs, joints and masses of a support over the freedoms of a structure: at each node
///     K_s += k u u^T,     D gains the row u^T,     M_s += m on its freedoms.
/// Throws InputError if a direction needs a freedom that is not listed, or if no freedom of a node with a mass is.
SupportMatrices support_matrices(const Support& support, const std::vector<Freedom>& freedoms);

}  // namespace wishbone
