#pragma once

#include <filesystem>

#include "identification/methods/modes.h"

namespace wishbone {

/// Reads a real matrix in MatrixMarket exchange format [Boisvert, Pozo, Remington: The Matrix Market Exchange
/// Formats, NISTIR 5935 (1996)]:
///
///     %%MatrixMarket matrix coordinate real symmetric
///     % comment
///     3 3 4                     rows, columns, entries
///     1 1 2.5                   row, column (from 1), value
///     ...
///
/// `coordinate` or `array` (column by column; its zeros are not stored), `real` or `integer`, `general`,
/// `symmetric` or `skew-symmetric`. Entries of a symmetric or skew-symmetric matrix may stand in either triangle
/// but, with their mirror image, once only. Comments and blank lines may stand anywhere below the first line.
///
/// Throws InputError with file, line and byte for anything else: indices out of range, an entry that is listed
/// twice (programs disagree whether such values add up), too few or too many entries, numbers that are not
/// finite, sizes beyond what the file can hold.
SparseMatrix read_matrix_market(const std::filesystem::path& path);

/// Writes the stored entries, column by column, so that reading gives the same bits. With `symmetric` only the
/// lower triangle is written. Throws InputError for a matrix that has entries that are not finite, or that is
/// to be symmetric and is not, to the last bit; NumericsError when writing fails.
void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix, bool symmetric);

}  // namespace wishbone
