#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/expression.h"
#include "core/function.h"
#include "identification/formats/csv_table.h"
#include "models/identification_sections.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

struct Points {
  std::vector<double> x, y;
};

std::vector<std::string> variable_names(const Scene& scene) {
  std::vector<std::string> names{"t"};
  for (const Scene::Signal& signal : scene.signals) names.push_back(signal.name);
  return names;
}

Function read_expression(const Value& value, const Scene& scene) {
  const Expression expression = located(
      value.where(), [&] { return Expression(value.text(), variable_names(scene), scene.parameters); });
  if (!expression.variables().empty()) return Function(expression);
  const double constant = expression(std::span<const double>());
  if (!std::isfinite(constant))
    value.refuse("the value of the expression is not finite",
                 "look for a division by zero or a root of a negative number");
  return constant;
}

Points read_points(const Value& list, const Dimension& x, const Dimension& y) {
  Points points;
  for (const Value& point : list.list()) {
    const std::vector<Value> pair = point.list();
    if (pair.size() != 2) point.refuse("a point of a table is a pair", "write [place, value]");
    points.x.push_back(pair[0].number(x));
    points.y.push_back(pair[1].number(y));
  }
  return points;
}

/// The two columns that `columns` names, or the only two.
std::array<std::size_t, 2> columns_of(const CsvTable& table, const std::optional<Value>& names,
                                      const Value& file) {
  if (!names) {
    if (table.columns().size() != 2)
      file.refuse(fmt::format("the table has {} columns", table.columns().size()),
                  "name the two that are meant, as in 'columns: [time, angle]'");
    return {0, 1};
  }
  const std::vector<Value> pair = names->list();
  if (pair.size() != 2) names->refuse("a table is made of two columns", "write [place, value]");
  std::vector<std::string> known;
  for (const CsvColumn& column : table.columns()) known.push_back(column.name);
  return {static_cast<std::size_t>(index_of(known, pair[0], "the columns")),
          static_cast<std::size_t>(index_of(known, pair[1], "the columns"))};
}

Points read_points_file(const Mapping& keys, const Dimension& x, const Dimension& y, Scene& scene) {
  const Value file = keys.required("file");
  identification_sections::Files files;
  const auto path = files.note(file);
  scene.data_files.insert(scene.data_files.end(), files.read().begin(), files.read().end());
  CsvTable table = within(file.where(), [&] { return CsvTable(path); });
  const auto [column_x, column_y] = columns_of(table, keys.optional("columns"), file);
  Points points;
  within(file.where(), [&, at_x = column_x, at_y = column_y] {
    const double to_x = table.si_factor(at_x, x), to_y = table.si_factor(at_y, y);
    while (table.next_row()) {
      points.x.push_back(table.number(at_x) * to_x);
      points.y.push_back(table.number(at_y) * to_y);
    }
  });
  return points;
}

Function read_table(const Value& value, const Dimension& dimension, Table::Interpolation usual,
                    Scene& scene) {
  const Mapping keys(value, {"points", "file", "columns", "interpolation", "of"});
  int variable = Function::kTime;
  if (const auto of = keys.optional("of"))
    variable = index_of(variable_names(scene), *of, "the time 't' and the signals");
  const Dimension& place = variable == Function::kTime
                               ? kTime
                               : dimension_of(scene.signals[static_cast<std::size_t>(variable) - 1], scene);
  if (keys.has("points") == keys.has("file"))
    keys.refuse("a table needs points, from one source", "give either 'points' or 'file'");
  if (keys.has("points") && keys.has("columns"))
    keys.refuse("points have no columns", "remove 'columns', or read the points from a 'file'");
  const Points points = keys.has("points") ? read_points(keys.required("points"), place, dimension)
                                           : read_points_file(keys, place, dimension, scene);
  Table::Interpolation interpolation = usual;
  if (const auto word = keys.optional("interpolation"))
    interpolation = word->choice<Table::Interpolation>(
        {{"linear", Table::Interpolation::linear}, {"spline", Table::Interpolation::spline}},
        "the interpolations");
  return located(value.where(),
                 [&] { return Function(Table("", points.x, points.y, interpolation), variable); });
}

}  // namespace

std::optional<Function> read_law(const Mapping& keys, const Dimension& dimension, Table::Interpolation usual,
                                 Scene& scene) {
  const auto expression = keys.optional("expression"), table = keys.optional("table");
  if (expression && table) keys.refuse("the function is given twice", "give either 'expression' or 'table'");
  if (expression) return read_expression(*expression, scene);
  if (table) return read_table(*table, dimension, usual, scene);
  return std::nullopt;
}

Function read_function(const Value& value, const Dimension& dimension, Scene& scene) {
  if (!value.is_mapping()) return value.number(dimension);
  const Mapping keys(value, {"expression", "table"});
  const auto law = read_law(keys, dimension, Table::Interpolation::linear, scene);
  if (!law) keys.refuse("the function is empty", "give 'expression' or 'table'");
  return *law;
}

std::array<Function, 3> read_functions(const Value& value, const Dimension& dimension, Scene& scene) {
  const std::vector<Value> items = value.is_list() ? value.list() : std::vector<Value>();
  if (items.size() != 3)
    value.refuse(
        fmt::format("a list of three components ({} [{}]) is wanted here", dimension.name, dimension.unit),
        "write [x, y, z], each a number, {expression: ...} or {table: ...}");
  return {read_function(items[0], dimension, scene), read_function(items[1], dimension, scene),
          read_function(items[2], dimension, scene)};
}

}  // namespace wishbone::scene_sections
