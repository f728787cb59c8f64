#include "identification/formats/csv_modal_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "identification/formats/csv_frequencies.h"
#include "identification/formats/csv_quantity.h"
#include "identification/formats/csv_table.h"

namespace wishbone {
namespace {

/// The mode that a column of shapes is called after: 7 of `mode_7`, `mode 7` or `7`.
std::optional<int> mode_of_column(std::string_view name) {
  for (const std::string_view prefix : {"mode_", "mode "})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  int mode = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), mode);
  if (name.empty() || error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return mode;
}

/// The columns of the modes in their order.
std::vector<std::size_t> mode_columns(const CsvTable& table, const std::vector<int>& modes) {
  constexpr std::size_t kMissing = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> columns(modes.size(), kMissing);
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const CsvColumn& column = table.columns()[i];
    if (column.name == "node" || column.name == "axis") continue;
    const auto mode = mode_of_column(column.name);
    const auto found = mode ? std::lower_bound(modes.begin(), modes.end(), *mode) : modes.end();
    if (found == modes.end() || *found != *mode)
      table.reject_column(i, "no mode of the table of frequencies has this number",
                          "name the columns mode_1, mode_2, ... as the modes are numbered there");
    if (!column.unit.empty() && column.unit != "1")
      table.reject_column(i, "amplitudes have no unit",
                          "the modal mass goes with their scale: leave the unit away");
    std::size_t& place = columns[static_cast<std::size_t>(found - modes.begin())];
    if (place != kMissing) table.reject_column(i, "this mode has two columns", "remove one of them");
    place = i;
  }
  for (std::size_t j = 0; j < modes.size(); ++j)
    if (columns[j] == kMissing) table.column(fmt::format("mode_{}", modes[j]));  // says that it is not there
  return columns;
}

/// An axis of the body and whether it counts against it.
struct Direction {
  int axis = 0;
  double sign = 1;
};

Direction direction_of_row(const CsvTable& table, std::size_t column) {
  constexpr std::string_view kAxes = "xyzXYZ123";
  std::string axis = table.text(column);
  const double sign = axis.starts_with('-') ? -1 : 1;
  if (axis.starts_with('-') || axis.starts_with('+')) axis.erase(0, 1);
  const auto found = axis.size() == 1 ? kAxes.find(axis[0]) : std::string_view::npos;
  if (found == std::string_view::npos)
    table.reject(column, "the axis must be x, y or z, or 1, 2 or 3",
                 "with a minus when it was measured against it");
  return {static_cast<int>(found % 3), sign};
}

struct ShapeTable {
  std::vector<Freedom> freedoms;
  MatrixX shapes;
};

ShapeTable read_shapes(const std::filesystem::path& path, const NodeTable& nodes,
                       const std::vector<int>& modes) {
  CsvTable table(path);
  const std::size_t node = table.column("node"), axis = table.column("axis");
  const std::vector<std::size_t> columns = mode_columns(table, modes);
  const std::set<int> known(nodes.ids.begin(), nodes.ids.end());
  std::set<std::pair<int, int>> taken;
  ShapeTable result;
  std::vector<double> values;
  while (table.next_row()) {
    const Direction direction = direction_of_row(table, axis);
    const Freedom freedom{table.integer(node), direction.axis};
    if (!known.contains(freedom.node))
      table.reject(node, "the table of nodes has no such node", "add it there");
    if (!taken.emplace(freedom.node, freedom.axis).second)
      table.reject(axis, fmt::format("the freedom {} has a row already", to_string(freedom)),
                   "remove one of them");
    result.freedoms.push_back(freedom);
    for (const std::size_t column : columns) values.push_back(direction.sign * table.number(column));
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  result.shapes = Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(result.freedoms.size()),
                                             static_cast<Eigen::Index>(columns.size()));
  return result;
}

}  // namespace

CsvModalFiles csv_modal_files(std::filesystem::path name) {
  if (name.extension() == ".csv" || name.extension() == ".CSV") name.replace_extension();
  const std::string stem = name.string();
  return {stem + "_nodes.csv", stem + "_frequencies.csv", stem + "_shapes.csv"};
}

NodeTable read_csv_nodes(const std::filesystem::path& path) {
  CsvTable table(path);
  const std::size_t node = table.column("node");
  for (const std::string_view axis : {"x", "y", "z"}) table.column(axis);
  table.allow_only({"node", "x", "y", "z", "mass"});
  const std::array<CsvQuantity, 3> axes{CsvQuantity(table, "x", kLength), CsvQuantity(table, "y", kLength),
                                        CsvQuantity(table, "z", kLength)};
  const CsvQuantity mass(table, "mass", kMass);

  NodeTable nodes;
  std::set<int> taken;
  std::vector<double> positions, masses;
  while (table.next_row()) {
    nodes.ids.push_back(table.integer(node));
    if (!taken.insert(nodes.ids.back()).second)
      table.reject(node, "this node has a row already", "number each node once");
    for (const CsvQuantity& axis : axes) positions.push_back(axis.value());
    if (!mass.is_given()) continue;
    masses.push_back(mass.value());
    if (!(masses.back() >= 0)) mass.reject("the mass of a node must not be negative", "give its lumped mass");
  }
  if (nodes.ids.empty()) table.reject_column(node, "the table has no rows", "give every node a row");
  const auto count = static_cast<Eigen::Index>(nodes.ids.size());
  nodes.position = Eigen::Map<const Matrix3X>(positions.data(), 3, count);
  if (mass.is_given()) nodes.mass = Eigen::Map<const VectorX>(masses.data(), count);
  return nodes;
}

ModalData read_csv_modal_data(const CsvModalFiles& files) {
  NodeTable nodes = read_csv_nodes(files.nodes);
  FrequencyTable frequencies = read_csv_frequencies(files.frequencies);
  ShapeTable shapes = read_shapes(files.shapes, nodes, frequencies.modes);
  ModalData data;
  data.node_ids = std::move(nodes.ids);
  data.node_position = std::move(nodes.position);
  data.node_mass = std::move(nodes.mass);
  data.omega = std::move(frequencies.omega);
  data.damping_ratio = std::move(frequencies.damping_ratio);
  data.modal_mass = std::move(frequencies.modal_mass);
  data.freedoms = std::move(shapes.freedoms);
  data.shapes = std::move(shapes.shapes);
  data.provenance = {fmt::format("read from {}, {} and {}", files.nodes.string(), files.frequencies.string(),
                                 files.shapes.string())};
  data.validate();
  return data;
}

}  // namespace wishbone
