#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.h"
#include "identification/formats/line_reader.h"

namespace wishbone {

/// A column of a CSV table, from its header.
struct CsvColumn {
  std::string name;        ///< in lower case, without its unit
  std::string unit;        ///< "mm" of `x[mm]`, or from the row of units; empty: none given
  std::string where;       ///< place of the name
  std::string unit_where;  ///< place of the unit
};

/// A table of values separated by commas, semicolons or tabs, read row by row:
///
///     # comment
///     node, x[mm], y[mm], z[mm]
///     17,   0,     250.5, -3e2
///
/// The first line that is neither blank nor a comment names the columns, each once; a semicolon or else a tab in
/// it is the separator, otherwise the comma is. Units stand in brackets behind the names, or in a row of their
/// own below, where `-` or nothing stands for none. Fields may be quoted ("a ""b"" c"), but not run over lines.
/// Numbers have a decimal point.
///
/// Throws InputError with file, line and byte, for a row that is longer or shorter than the header too.
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& path);

  const std::vector<CsvColumn>& columns() const { return columns_; }
  /// Index of a column by name; nothing when there is none.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Index of a column that must be there.
  std::size_t column(std::string_view name) const;
  /// Throws InputError at the first column whose name is not among `names`.
  void allow_only(const std::vector<std::string>& names) const;
  /// Throws InputError at the header of the column.
  [[noreturn]] void reject_column(std::size_t column, std::string what, std::string remedy) const;
  /// What turns numbers of this column into SI: 1 without unit. Throws InputError when the unit is unknown or
  /// measures something else.
  double si_factor(std::size_t column, const Dimension& dimension) const;

  /// Goes to the next row; false after the last.
  bool next_row();
  /// Fields of the row.
  std::string text(std::size_t column) const;
  bool is_empty(std::size_t column) const { return fields_[column].empty(); }
  double number(std::size_t column) const { return reader_.number(fields_[column]); }
  /// An integer that fits an int.
  int integer(std::size_t column) const;
  /// Throws InputError at a field of the row.
  [[noreturn]] void reject(std::size_t column, std::string what, std::string remedy) const {
    reader_.reject(fields_[column], std::move(what), std::move(remedy));
  }

 private:
  bool next_content();
  void read_header();
  void read_units();
  void split();
  std::string_view take_quoted(std::string_view& rest) const;
  std::string_view take_plain(std::string_view& rest) const;

  LineReader reader_;
  char separator_ = ',';
  std::vector<CsvColumn> columns_;
  std::vector<std::string_view>
      fields_;                 ///< of the row, parts of the line: without blanks and quotes around them
  bool at_first_row_ = false;  ///< the row that was read ahead to look for units is still to be given
};

}  // namespace wishbone
