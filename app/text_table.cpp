#include "app/text_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace wishbone {

TextTable::TextTable(std::vector<std::string> header, int text_columns)
    : rows_{std::move(header)}, text_columns_(static_cast<std::size_t>(text_columns)) {}

void TextTable::add_row(std::vector<std::string> cells) {
  rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());

  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i < text_columns_ ? fmt::format("{:<{}}  ", row[i], widths[i])
                                : fmt::format("{:>{}}  ", row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string brief(double value) {
  return fmt::format("{:.4g}", value);
}

}  // namespace wishbone
