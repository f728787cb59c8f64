#include "identification/formats/matrix_market.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "core/error.h"
#include "identification/formats/line_reader.h"
#include "identification/formats/matrix_market_header.h"

namespace wishbone {
namespace {

using Symmetry = MatrixMarketHeader::Symmetry;
using Index = SparseMatrix::StorageIndex;
using Triplet = Eigen::Triplet<double, Index>;

constexpr std::int64_t kLargestExact = std::int64_t{1} << 53;

double read_value(const LineReader& reader, const MatrixMarketHeader& header, std::string_view word) {
  if (!header.is_integer) return reader.number(word);
  const std::int64_t value = reader.integer(word);
  if (value < -kLargestExact || value > kLargestExact)
    reader.reject(word, "a double does not hold this integer exactly", "call the matrix 'real'");
  return static_cast<double>(value);
}

/// An index that the file counts from 1.
Index read_index(const LineReader& reader, std::string_view word, std::int64_t size, std::string_view what) {
  const std::int64_t index = reader.integer(word);
  if (index < 1 || index > size)
    reader.reject(word, fmt::format("the {} must be from 1 to {}", what, size),
                  "correct it, or the line of sizes");
  return static_cast<Index>(index - 1);
}

void go_to_entry(LineReader& reader, const MatrixMarketHeader& header, std::int64_t done) {
  if (next_matrix_market_line(reader)) return;
  reader.reject(reader.line(), fmt::format("the file ends after {} of {} entries", done, header.entries),
                "was the file cut short?");
}

template <class Use>
void read_coordinates(LineReader& reader, const MatrixMarketHeader& header, Use use) {
  std::array<std::string_view, 3> words;
  for (std::int64_t k = 0; k < header.entries; ++k) {
    go_to_entry(reader, header, k);
    split_words(reader, "an entry (row, column, value)", words);
    const Index row = read_index(reader, words[0], header.rows, "row");
    const Index column = read_index(reader, words[1], header.columns, "column");
    if (row == column && header.symmetry == Symmetry::kSkew)
      reader.reject(words[0], "a skew-symmetric matrix has no entries on its diagonal", "remove the entry");
    use(Triplet(row, column, read_value(reader, header, words[2])));
  }
}

template <class Use>
void read_array(LineReader& reader, const MatrixMarketHeader& header, Use use) {
  std::array<std::string_view, 1> words;
  std::int64_t done = 0;
  for (std::int64_t column = 0; column < header.columns; ++column)
    for (std::int64_t row = header.first_row(column); row < header.rows; ++row) {
      go_to_entry(reader, header, done++);
      split_words(reader, "an element of an array", words);
      const double value = read_value(reader, header, words[0]);
      if (value != 0) use(Triplet(static_cast<Index>(row), static_cast<Index>(column), value));
    }
}

/// Calls `use` with every entry as the file lists it.
template <class Use>
void read_entries(LineReader& reader, const MatrixMarketHeader& header, Use use) {
  if (header.is_array)
    read_array(reader, header, use);
  else
    read_coordinates(reader, header, use);
  if (next_matrix_market_line(reader))
    reader.reject(without_blanks(reader.line()),
                  fmt::format("there are more than {} entries", header.entries), "correct the line of sizes");
}

/// Entries are not remembered with their lines, which would cost as much as the matrix: they are read again.
[[noreturn]] void reject_repeated_entry(const std::filesystem::path& path) {
  LineReader reader(path);
  const MatrixMarketHeader header = read_matrix_market_header(reader);
  std::unordered_set<std::int64_t> taken;
  read_entries(reader, header, [&](const Triplet& entry) {
    auto [row, column] = std::pair<std::int64_t, std::int64_t>(entry.row(), entry.col());
    if (header.symmetry != Symmetry::kGeneral && row < column) std::swap(row, column);
    if (!taken.insert(column * header.rows + row).second)
      reader.reject(without_blanks(reader.line()), "this element (or its mirror image) has an entry already",
                    "remove one, or add the two up: programs disagree which is meant");
  });
  throw InputError({path.string(), "an element has two entries", "", "the file changed while it was read"});
}

}  // namespace

SparseMatrix read_matrix_market(const std::filesystem::path& path) {
  LineReader reader(path);
  const MatrixMarketHeader header = read_matrix_market_header(reader);
  std::vector<Triplet> triplets;
  triplets.reserve(static_cast<std::size_t>(header.entries) *
                   (header.symmetry == Symmetry::kGeneral ? 1 : 2));
  read_entries(reader, header, [&](const Triplet& entry) {
    triplets.push_back(entry);
    if (header.symmetry == Symmetry::kGeneral || entry.row() == entry.col()) return;
    const double mirrored = header.symmetry == Symmetry::kSkew ? -entry.value() : entry.value();
    triplets.emplace_back(entry.col(), entry.row(), mirrored);
  });
  SparseMatrix matrix(static_cast<Index>(header.rows), static_cast<Index>(header.columns));
  bool repeated = false;
  matrix.setFromTriplets(triplets.begin(), triplets.end(), [&](double first, double) {
    repeated = true;
    return first;
  });
  if (repeated) reject_repeated_entry(path);
  return matrix;
}

}  // namespace wishbone
