#include "identification/formats/matrix_market_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "identification/methods/modes.h"

namespace wishbone {
namespace {

using Symmetry = MatrixMarketHeader::Symmetry;

constexpr std::int64_t kLargestIndex = std::numeric_limits<SparseMatrix::StorageIndex>::max();

bool is_word(std::string_view text, std::string_view word) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                    [&](char a, char b) { return lower(a) == b; });
}

void read_field(const LineReader& reader, std::string_view field, MatrixMarketHeader& header) {
  if (is_word(field, "pattern"))
    reader.reject(field, "a pattern has no values", "write the matrix with its values, as 'real'");
  if (is_word(field, "complex"))
    reader.reject(field, "a complex matrix is neither a mass nor a stiffness matrix",
                  "write its real part as a 'real' matrix");
  header.is_integer = is_word(field, "integer");
  if (!header.is_integer && !is_word(field, "real"))
    reader.reject(field, "the field must be 'real' or 'integer'", "correct the first line");
}

void read_symmetry(const LineReader& reader, std::string_view symmetry, MatrixMarketHeader& header) {
  if (is_word(symmetry, "hermitian"))
    reader.reject(symmetry, "a hermitian matrix is complex", "call it 'symmetric' if it is real");
  if (is_word(symmetry, "symmetric"))
    header.symmetry = Symmetry::kSymmetric;
  else if (is_word(symmetry, "skew-symmetric"))
    header.symmetry = Symmetry::kSkew;
  else if (!is_word(symmetry, "general"))
    reader.reject(symmetry, "the symmetry must be 'general', 'symmetric' or 'skew-symmetric'",
                  "correct the first line");
}

void read_banner(LineReader& reader, MatrixMarketHeader& header) {
  if (!reader.next() ||
      !is_word(reader.line().substr(0, reader.line().find_first_of(" \t")), "%%matrixmarket"))
    reader.reject(reader.line(), "this is not a MatrixMarket file",
                  "its first line is like '%%MatrixMarket matrix coordinate real symmetric'");
  std::array<std::string_view, 5> words;
  split_words(reader, "the first line", words);
  const auto [banner, object, layout, field, symmetry] = words;
  if (!is_word(object, "matrix"))
    reader.reject(object, "only a 'matrix' can be read", "correct the first line");
  header.is_array = is_word(layout, "array");
  if (!header.is_array && !is_word(layout, "coordinate"))
    reader.reject(layout, "the layout must be 'coordinate' or 'array'", "correct the first line");
  read_field(reader, field, header);
  read_symmetry(reader, symmetry, header);
}

std::int64_t read_size(const LineReader& reader, std::string_view word) {
  const std::int64_t size = reader.integer(word);
  if (size < 0 || size > kLargestIndex)
    reader.reject(word, fmt::format("sizes are from 0 to {}", kLargestIndex), "correct the size");
  return size;
}

std::int64_t array_entries(const MatrixMarketHeader& header) {
  if (header.symmetry == Symmetry::kGeneral) return header.rows * header.columns;
  const std::int64_t diagonal = header.symmetry == Symmetry::kSymmetric ? header.rows : 0;
  return header.rows * (header.rows - 1) / 2 + diagonal;
}

void check_sizes(const LineReader& reader, const MatrixMarketHeader& header) {
  const auto refuse = [&](std::string what, std::string remedy) {
    reader.reject(without_blanks(reader.line()), std::move(what), std::move(remedy));
  };
  if (header.symmetry != Symmetry::kGeneral && header.rows != header.columns)
    refuse("a symmetric matrix has as many columns as rows",
           "correct the size, or call the matrix 'general'");
  const std::string_view shortest = header.is_array ? "1\n" : "1 1 1\n";
  if (static_cast<std::uintmax_t>(header.entries) > reader.bytes_left() / shortest.size())
    refuse(fmt::format("the rest of the file is too short for {} entries", header.entries),
           "was the file cut short?");
  if (header.entries > kLargestIndex / 2) refuse("this matrix has too many entries", "reduce the model");
  constexpr std::int64_t kFreelyEmpty = 10'000'000;  // indices of empty rows take memory that no file backs
  if (std::max(header.rows, header.columns) > kFreelyEmpty + header.entries)
    refuse("nearly all rows or columns of so large a matrix would be empty", "correct the size");
}

}  // namespace

MatrixMarketHeader read_matrix_market_header(LineReader& reader) {
  MatrixMarketHeader header;
  read_banner(reader, header);
  if (!next_matrix_market_line(reader))
    reader.reject(reader.line(), "the file ends before the line of sizes", "was the file cut short?");
  std::array<std::string_view, 3> words;
  const std::size_t count = header.is_array ? 2 : 3;
  split_words(
      reader,
      header.is_array ? "the line of sizes (rows, columns)" : "the line of sizes (rows, columns, entries)",
      std::span(words).first(count));
  header.rows = read_size(reader, words[0]);
  header.columns = read_size(reader, words[1]);
  header.entries = header.is_array ? array_entries(header) : read_size(reader, words[2]);
  check_sizes(reader, header);
  return header;
}

bool next_matrix_market_line(LineReader& reader) {
  while (reader.next())
    if (const auto content = without_blanks(reader.line()); !content.empty() && content.front() != '%')
      return true;
  return false;
}

void split_words(const LineReader& reader, std::string_view what, std::span<std::string_view> words) {
  std::string_view rest = without_blanks(reader.line());
  for (std::string_view& word : words) {
    if (rest.empty())
      reader.reject(rest, fmt::format("{} must have {} words", what, words.size()), "complete the line");
    word = rest.substr(0, rest.find_first_of(" \t"));
    rest = rest.substr(word.size());
    rest = rest.substr(std::min(rest.find_first_not_of(" \t"), rest.size()));
  }
  if (!rest.empty())
    reader.reject(rest, fmt::format("{} must have {} words", what, words.size()), "remove what follows");
}

}  // namespace wishbone
