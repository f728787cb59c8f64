#include "identification/formats/csv_frequencies.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "identification/formats/csv_quantity.h"
#include "identification/formats/csv_table.h"

namespace wishbone {
namespace {

constexpr Dimension kFrequency{"frequency", "Hz"};

VectorX vector_of(const std::vector<double>& values) {
  return Eigen::Map<const VectorX>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Of two columns that mean the same, the one that is there.
std::string_view either(const CsvTable& table, std::string_view name, std::string_view other) {
  const auto index = table.find(other);
  if (index && table.find(name))
    table.reject_column(*index, fmt::format("this means the same as the column '{}'", name),
                        "remove one of them");
  return index ? other : name;
}

/// The columns of a table of frequencies.
struct FrequencyColumns {
  explicit FrequencyColumns(const CsvTable& table)
      : mode(table.column("mode")),
        frequency(table, either(table, "frequency", "frequency_hz"), kFrequency),
        omega(table, "omega", kAngularVelocity),
        damping(table, either(table, "damping", "damping_ratio"), kRatio),
        modal_mass(table, "modal_mass", kMass) {
    table.allow_only(
        {"mode", "frequency", "frequency_hz", "omega", "damping", "damping_ratio", "modal_mass"});
    if (!frequency.is_given() && !omega.is_given()) table.column("frequency");  // says that it is not there
    if (const auto hz = table.find("frequency_hz"); hz && !table.columns()[*hz].unit.empty())
      table.reject_column(*hz, "the name tells the unit already",
                          "call it frequency, or leave its unit away");
  }

  std::size_t mode;
  CsvQuantity frequency, omega, damping, modal_mass;
};

double omega_of_row(const FrequencyColumns& columns) {
  constexpr double kAgreement = 1e-6;
  const CsvQuantity& column = columns.omega.is_given() ? columns.omega : columns.frequency;
  const double omega =
      columns.omega.is_given() ? columns.omega.value() : 2 * std::numbers::pi * columns.frequency.value();
  if (!(omega > 0))
    column.reject("the frequency must be positive",
                  "leave rigid-body modes of a free structure out: they follow from its geometry");
  if (columns.omega.is_given() && columns.frequency.is_given() &&
      !(std::abs(2 * std::numbers::pi * columns.frequency.value() - omega) <= kAgreement * omega))
    columns.frequency.reject(
        fmt::format("this is not omega / (2 pi) = {:.9g} Hz", omega / (2 * std::numbers::pi)),
        "correct the frequency or omega, or remove one of the columns");
  return omega;
}

double damping_of_row(const CsvQuantity& column) {
  const double damping = column.is_given() ? column.value() : 0;
  if (!(damping >= 0)) column.reject("the damping must not be negative", "give 0 for an undamped mode");
  return damping;
}

double modal_mass_of_row(const CsvQuantity& column) {
  if (!column.is_given() || column.is_empty()) return std::numeric_limits<double>::quiet_NaN();
  const double mass = column.value();
  if (!(mass > 0)) column.reject("the modal mass must be positive", "leave it empty when it is not known");
  return mass;
}

}  // namespace

FrequencyTable read_csv_frequencies(const std::filesystem::path& path) {
  CsvTable table(path);
  const FrequencyColumns columns(table);
  FrequencyTable result;
  std::vector<double> omega, damping, modal_mass;
  while (table.next_row()) {
    const int mode = table.integer(columns.mode);
    if (!result.modes.empty() && mode <= result.modes.back())
      table.reject(columns.mode, "the numbers of the modes must ascend", "number each mode once, in order");
    result.modes.push_back(mode);
    omega.push_back(omega_of_row(columns));
    if (omega.size() > 1 && omega.back() < omega[omega.size() - 2])
      (columns.omega.is_given() ? columns.omega : columns.frequency)
          .reject("frequencies must ascend", "sort the modes");
    damping.push_back(damping_of_row(columns.damping));
    modal_mass.push_back(modal_mass_of_row(columns.modal_mass));
  }
  if (result.modes.empty())
    table.reject_column(columns.mode, "the table has no rows", "give every mode a row");
  result.omega = vector_of(omega);
  result.damping_ratio = vector_of(damping);
  result.modal_mass = vector_of(modal_mass);
  return result;
}

}  // namespace wishbone
