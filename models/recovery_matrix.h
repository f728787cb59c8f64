#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// A matrix R that recovers quantities r = R z, stresses or strains, from the modal coordinates z [m sqrt(kg)] of a body.
struct RecoveryMatrix {
  std::vector<std::string> row_names;  ///< of every row; empty: the file names none
  MatrixX R;                           ///< rows x modes
};

/// Reads R from a MatrixMarket file (`.mtx`), rows x modes, or else from a CSV table with a column for each mode, in their
/// order, named as one likes, and where rows have names a column `row` with them:
///
///     row,           mode 1, mode 2
///     gauge 3,       1.2e6,  -4e5
///     element 7 sxx, 0,      3.1e6
///
/// @throws InputError with file, line and byte for files that are neither, a matrix without rows or columns, a row name that is
///   missing or given twice, and units behind the names of columns, for which there is no place
RecoveryMatrix read_recovery_matrix(const std::filesystem::path& path);

}  // namespace wishbone
