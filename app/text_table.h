#pragma once

#include <string>
#include <vector>

namespace wishbone {

/// A table for terminals: columns as wide as their widest cell, first column flush left, numbers flush right.
class TextTable {
 public:
  /// `text_columns`: how many columns, counted from the left, hold text.
  TextTable(std::vector<std::string> header, int text_columns);

  void add_row(std::vector<std::string> cells);
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
  std::size_t text_columns_;
};

/// A number for people: four significant digits.
std::string brief(double value);

}  // namespace wishbone
