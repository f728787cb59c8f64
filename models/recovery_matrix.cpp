#include "models/recovery_matrix.h"

#include <fmt/format.h>

#include <set>

#include "core/error.h"
#include "identification/formats/csv_table.h"
#include "identification/formats/matrix_market.h"

namespace wishbone {
namespace {

constexpr const char* kNameColumn = "row";

/// Columns of the table that hold modes.
std::vector<std::size_t> mode_columns(const CsvTable& table) {
  std::vector<std::size_t> modes;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    if (table.columns()[i].name == kNameColumn) continue;
    if (!table.columns()[i].unit.empty())
      table.reject_column(i, "columns of a recovery matrix have no units",
                          "remove the unit; the scene gives that of the recovered quantity");
    modes.push_back(i);
  }
  if (modes.empty())
    table.reject_column(0, "the table has no column of a mode", "give one for each elastic mode of the body");
  return modes;
}

RecoveryMatrix read_table(const std::filesystem::path& path) {
  CsvTable table(path);
  const std::vector<std::size_t> modes = mode_columns(table);
  const auto name_column = table.find(kNameColumn);
  RecoveryMatrix matrix;
  std::set<std::string> taken;
  std::vector<double> values;  // row by row
  while (table.next_row()) {
    for (const std::size_t mode : modes) values.push_back(table.number(mode));
    if (!name_column) continue;
    matrix.row_names.push_back(table.text(*name_column));
    if (matrix.row_names.back().empty()) table.reject(*name_column, "the row has no name", "name it");
    if (!taken.insert(matrix.row_names.back()).second)
      table.reject(*name_column, "two rows have the same name", "rename or remove one");
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto columns = static_cast<Eigen::Index>(modes.size());
  matrix.R =
      Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns);
  return matrix;
}

}  // namespace

RecoveryMatrix read_recovery_matrix(const std::filesystem::path& path) {
  RecoveryMatrix matrix =
      path.extension() == ".mtx" ? RecoveryMatrix{{}, MatrixX(read_matrix_market(path))} : read_table(path);
  if (matrix.R.size() == 0)
    throw InputError({path.string(), "the recovery matrix is empty",
                      fmt::format("{} x {}", matrix.R.rows(), matrix.R.cols()),
                      "give a row for each quantity and a column for each elastic mode of the body"});
  return matrix;
}

}  // namespace wishbone
