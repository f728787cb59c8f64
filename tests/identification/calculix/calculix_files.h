#pragma once

#include <string>
#include <vector>

#include "identification/methods/modes.h"
#include "identification/modal_data.h"

namespace wishbone {

// Readers of what CalculiX leaves behind. All throw InputError naming file and line.

/// Eigenvalues [rad2/s2] of the table "EIGENVALUE OUTPUT" of a .dat file, seven digits each.
VectorX read_dat_eigenvalues(const std::string& path);

/// Mode shapes (3n x m) of the MODAL blocks of a .frd file over the nodes given, node by node in x, y, z:
/// fixed columns, six digits each.
MatrixX read_frd_shapes(const std::string& path, const std::vector<int>& node_ids);

}  // namespace wishbone
