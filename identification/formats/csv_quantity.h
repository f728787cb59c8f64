#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/units.h"
#include "identification/formats/csv_table.h"

namespace wishbone {

/// A column of a CSV table that holds a physical quantity, seen in SI.
class CsvQuantity {
 public:
  /// The column of that name, if the table has one. Throws InputError when its unit is wrong.
  CsvQuantity(const CsvTable& table, std::string_view name, const Dimension& dimension)
      : table_(table), column_(table.find(name)) {
    if (column_) factor_ = table.si_factor(*column_, dimension);
  }

  bool is_given() const { return column_.has_value(); }
  /// Of the row at hand; throws InputError at the field unless it is a finite number.
  double value() const {
    const double value = table_.number(*column_) * factor_;
    if (!std::isfinite(value)) reject("the number does not fit a double in SI units", "use a smaller one");
    return value;
  }
  bool is_empty() const { return table_.is_empty(*column_); }
  /// Throws InputError at the field.
  [[noreturn]] void reject(std::string what, std::string remedy) const {
    table_.reject(*column_, std::move(what), std::move(remedy));
  }

 private:
  const CsvTable& table_;
  std::optional<std::size_t> column_;
  double factor_ = 1;
};

}  // namespace wishbone
