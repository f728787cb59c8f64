#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "identification/formats/line_reader.h"

namespace wishbone {

/// What the first lines of a MatrixMarket file say.
struct MatrixMarketHeader {
  enum class Symmetry { kGeneral, kSymmetric, kSkew };

  bool is_array = false;    ///< all elements column by column; otherwise entries with their indices
  bool is_integer = false;  ///< values are integers
  Symmetry symmetry = Symmetry::kGeneral;
  std::int64_t rows = 0, columns = 0;
  std::int64_t entries = 0;  ///< lines with a value that follow

  /// First row that an array lists of a column: on the diagonal, or below, where the rest follows by symmetry.
  std::int64_t first_row(std::int64_t column) const {
    return symmetry == Symmetry::kGeneral ? 0 : symmetry == Symmetry::kSymmetric ? column : column + 1;
  }
};

/// Reads up to and including the line of sizes. Throws InputError for formats and sizes that cannot be read, and
/// for more entries or empty rows than a file of this length can mean.
MatrixMarketHeader read_matrix_market_header(LineReader& reader);

/// Goes to the next line that is neither blank nor a comment; false at the end of the file.
bool next_matrix_market_line(LineReader& reader);

/// Fills `words` with those of the line. Throws InputError unless `what` has exactly as many.
void split_words(const LineReader& reader, std::string_view what, std::span<std::string_view> words);

}  // namespace wishbone
