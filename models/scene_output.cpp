#include <fmt/format.h>

#include <algorithm>

#include "models/identification_sections.h"
#include "models/recovery_matrix.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

double read_interval(const Value& value, const Scene& scene) {
  const double interval = value.positive(kTime);
  if (interval > scene.analysis.duration) {
    value.refuse(fmt::format("the interval is longer than the run of {} s", scene.analysis.duration),
                 "give a shorter one");
  }
  constexpr double kMostOutputs = 1e7;
  if (scene.analysis.duration / interval > kMostOutputs) {
    value.refuse("the run would have more than ten million outputs", "give a longer interval");
  }
  return interval;
}

/// A body that has modes as soon as its form is modal.
int read_flexible_body(const std::string& name, const Value& place, const Scene& scene) {
  const int body = index_of(scene.bodies, name, place, "the bodies");
  if (!scene.bodies[static_cast<std::size_t>(body)].flexible)
    place.refuse(fmt::format("the body '{}' has no modes", name),
                 "name a flexible body, or give this one the key 'flexible'");
  return body;
}

Scene::FlexibleOutput& output_of(int body, Scene::Output& output) {
  const auto found = std::find_if(output.flexible.begin(), output.flexible.end(),
                                  [&](const Scene::FlexibleOutput& o) { return o.body == body; });
  if (found != output.flexible.end()) return *found;
  output.flexible.push_back({body, {}, {}});
  return output.flexible.back();
}

void read_nodes(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    const int body = index_of(scene.bodies, name, value, "the bodies");
    for (const Value& node : value.list())
      output_of(body, scene.output)
          .nodes.push_back(read_node(node, scene.bodies[static_cast<std::size_t>(body)]));
  }
}

FlexibleSignal read_flexible_signal(const Value& word) {
  using enum FlexibleSignal;
  return word.choice<FlexibleSignal>({{"deflection_rates", deflection_rates},
                                      {"modal_rates", modal_rates},
                                      {"modal_accelerations", modal_accelerations},
                                      {"energies", energies},
                                      {"modal_energies", modal_energies},
                                      {"interface_forces", interface_forces}},
                                     "the signals of a flexible body");
}

void read_flexible_outputs(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    Scene::FlexibleOutput& output = output_of(read_flexible_body(name, value, scene), scene.output);
    for (const Value& word : value.list()) {
      const FlexibleSignal signal = read_flexible_signal(word);
      if (signal == FlexibleSignal::deflection_rates && output.nodes.empty())
        word.refuse(fmt::format("no nodes of '{}' are recorded", name), "name some under 'output.nodes'");
      if (!output.signals.insert(signal).second)
        word.refuse("the signal is in the list already", "remove one of the two");
    }
  }
}

/// A unit that udunits2 knows; "1" for pure numbers.
std::string read_unit(const Value& value) {
  const std::string& unit = value.text();
  try {
    if (unit != "1") parse_quantity("1 " + unit);
  } catch (const InputError&) {
    value.refuse("this is no unit", "write it as in MPa or N/mm2; 1 for strains and other pure numbers");
  }
  return unit;
}

std::string row_name(const RecoveryMatrix& matrix, Eigen::Index row) {
  return matrix.row_names.empty() ? std::to_string(row + 1) : matrix.row_names[static_cast<std::size_t>(row)];
}

/// Indices of the rows that a list names, all without a list.
std::vector<Eigen::Index> read_rows(const std::optional<Value>& list, const RecoveryMatrix& matrix) {
  std::vector<Eigen::Index> rows;
  if (!list)
    for (Eigen::Index row = 0; row < matrix.R.rows(); ++row) rows.push_back(row);
  else
    for (const Value& item : list->list())
      rows.push_back(matrix.row_names.empty() ? item.integer(1, static_cast<int>(matrix.R.rows())) - 1
                                              : index_of(matrix.row_names, item, "the rows of the file"));
  if (rows.empty()) list->refuse("there are no rows in the list", "remove the key to record all of them");
  return rows;
}

Scene::RecoveryOutput read_recovery(const std::string& name, const Value& value, Scene& scene) {
  const Mapping keys(value, {"body", "file", "unit", "rows"});
  Scene::RecoveryOutput output;
  output.name = name;
  const Value body = keys.required("body"), file = keys.required("file");
  output.body = read_flexible_body(body.text(), body, scene);
  output.unit = read_unit(keys.required("unit"));
  output.where = file.where();

  identification_sections::Files files;
  const auto path = files.note(file);
  scene.data_files.insert(scene.data_files.end(), files.read().begin(), files.read().end());
  const RecoveryMatrix matrix = within(file.where(), [&] { return read_recovery_matrix(path); });
  const std::vector<Eigen::Index> rows = read_rows(keys.optional("rows"), matrix);
  for (const Eigen::Index row : rows) output.rows.push_back(row_name(matrix, row));
  output.matrix = matrix.R(rows, Eigen::all);
  return output;
}

void read_record(const Value& section, Scene::Output& output) {
  for (const Value& pattern : section.list()) {
    output.record.push_back(pattern.text());
    if (!output.record.back().starts_with('/') && !output.record.back().starts_with('*'))
      pattern.refuse("this matches no path of a signal", "begin with a slash, as in /bodies/chassis/*");
  }
  if (output.record.empty())
    section.refuse("there are no patterns in the list", "remove the key to record all signals");
}

}  // namespace

void read_output(const Value& section, Scene& scene) {
  const Mapping keys(section, {"interval", "nodes", "flexible", "recovery", "points", "record"});
  Scene::Output& output = scene.output;
  output.where = section.where();
  if (const auto interval = keys.optional("interval")) output.interval = read_interval(*interval, scene);
  if (const auto nodes = keys.optional("nodes")) read_nodes(*nodes, scene);
  if (const auto flexible = keys.optional("flexible")) read_flexible_outputs(*flexible, scene);
  if (const auto recovery = keys.optional("recovery"))
    for (const auto& [name, value] : recovery->named())
      output.recoveries.push_back(read_recovery(name, value, scene));
  if (const auto points = keys.optional("points"))
    for (const auto& [name, value] : points->named()) {
      const Mapping point(value, {"body", "at", "node", "frame"});
      output.points.push_back({name, read_point(scene, point, value)});
    }
  if (const auto record = keys.optional("record")) read_record(*record, output);
}

}  // namespace wishbone::scene_sections
