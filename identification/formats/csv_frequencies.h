#pragma once

#include <filesystem>
#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// What a CSV table (csv_table.h) of natural frequencies says, with the columns
///     mode
///     frequency [Hz unless it has another unit], or frequency_hz, or omega [rad/s], or one of them and omega
///     damping or damping_ratio [1], may be missing
///     modal_mass [kg], may be missing, or empty where it is not known
struct FrequencyTable {
  std::vector<int> modes;  ///< m, ascending, as numbered in the file; need not begin with 1
  VectorX omega;           ///< m, > 0, ascending [rad/s]; as given when there is such a column
  VectorX damping_ratio;   ///< m, >= 0; zero without such a column
  VectorX modal_mass;      ///< m, > 0; NaN where it is not known [kg]
};

/// Throws InputError with file, line and byte of what is wrong; frequencies that contradict omega by more than
/// a millionth are.
FrequencyTable read_csv_frequencies(const std::filesystem::path& path);

}  // namespace wishbone
