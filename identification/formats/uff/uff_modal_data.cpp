#include "identification/formats/uff/uff_modal_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/error.h"
#include "core/utf8.h"
#include "core/version.h"
#include "identification/formats/uff/uff_elements.h"
#include "identification/formats/uff/uff_reader.h"
#include "identification/formats/uff/uff_systems.h"
#include "identification/formats/uff/uff_text.h"
#include "identification/formats/uff/uff_units.h"
#include "identification/formats/uff/uff_writer.h"

namespace wishbone {
namespace {

// ---- reading
// ------------------------------------------------------------------------------------------------

bool says_something(std::string_view text) {
  return !trimmed(text).empty() && trimmed(text) != "NONE";
}

std::string title_of(const UffFile& file, const std::filesystem::path& path) {
  if (file.header && says_something(file.header->model)) return as_utf8(trimmed(file.header->model));
  for (const UffShape& shape : file.shapes)
    for (const std::string& id : shape.ids)
      if (says_something(id)) return as_utf8(trimmed(id));
  return path.stem().string();
}

std::string origin_of(const UffFile& file, const std::filesystem::path& path) {
  std::string origin = fmt::format("read from the Universal File '{}'", path.filename().string());
  if (!file.header) return origin;
  if (says_something(file.header->program))
    origin += fmt::format(", written by {}", as_utf8(trimmed(file.header->program)));
  if (says_something(file.header->written))
    origin += fmt::format(" ({})", as_utf8(trimmed(file.header->written)));
  return origin;
}

/// Nodes that are listed once more in another system must be where they are.
void check_repeated(const UffFile& file, UffSystems& systems, const std::string& where) {
  std::unordered_map<int, const UffNode*> node_of;
  for (const UffNode& node : file.nodes) node_of.emplace(node.number, &node);
  for (const UffNode& again : file.repeated_nodes) {
    const Vector3 p = systems.position(*node_of.at(again.number)), q = systems.position(again);
    if ((p - q).norm() > 1e-5 * std::max(p.norm(), q.norm()))
      throw InputError({where, "a node is defined twice, differently", fmt::format("node {}", again.number),
                        "number each node once"});
  }
}

void put_positions(const UffFile& file, const UffScale& scale, const std::string& where, ModalData& data) {
  UffSystems systems(file.coordinate_systems, where);
  check_repeated(file, systems, where);
  data.node_position.resize(3, static_cast<Eigen::Index>(file.nodes.size()));
  for (const UffNode& node : file.nodes) {
    data.node_position.col(data.node_count()) = scale.metre * systems.position(node);
    data.node_ids.push_back(node.number);
  }
  const auto say = [&](const char* what, auto&& system_of) {
    const auto count = std::count_if(file.nodes.begin(), file.nodes.end(), [&](const UffNode& node) {
      return !systems.is_global(system_of(node));
    });
    if (count > 0) data.provenance.push_back(fmt::format("{} nodes have {}", count, what));
  };
  say("definition coordinate systems: positions were brought into global axes",
      [](const UffNode& node) { return node.definition_system; });
  say("export coordinate systems (dataset 2411): positions were taken as those of the part, as the format "
      "says",
      [](const UffNode& node) { return node.export_system; });
  if (std::any_of(file.coordinate_systems.begin(), file.coordinate_systems.end(),
                  [](const UffCoordinateSystem& system) { return system.type != 0; }))
    data.provenance.push_back(
        "cylindrical coordinates were taken as r, theta, z, spherical ones as r, theta from the z axis, phi "
        "about it; angles in degrees");
}

std::vector<std::array<int, 2>> segments(const UffTraceLine& trace) {
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t k = 0; k + 1 < trace.nodes.size(); ++k)
    if (trace.nodes[k] > 0 && trace.nodes[k + 1] > 0) pairs.push_back({trace.nodes[k], trace.nodes[k + 1]});
  return pairs;
}

void put_lines(const UffFile& file, ModalData& data) {
  const std::unordered_set<int> known(data.node_ids.begin(), data.node_ids.end());
  std::set<std::array<int, 2>> drawn;
  std::size_t unknown = 0;
  const auto put = [&](const std::vector<std::array<int, 2>>& pairs) {
    for (const auto& [a, b] : pairs) {
      if (!known.contains(a) || !known.contains(b))
        ++unknown;
      else if (a != b && drawn.insert({std::min(a, b), std::max(a, b)}).second)
        data.lines.push_back({a, b});
    }
  };
  for (const UffTraceLine& trace : file.trace_lines) put(segments(trace));
  for (const UffElement& element : file.elements) put(uff_element_edges(element));
  if (unknown > 0)
    data.provenance.push_back(fmt::format("left out {} lines to nodes without a position", unknown));
}

void say_unused(const UffFile& file, ModalData& data) {
  std::map<std::string, int> counts;
  for (const UffUnused& unused : file.unused)
    ++counts[fmt::format("dataset {}: {}", unused.dataset, unused.why)];
  for (const auto& [what, count] : counts)
    data.provenance.push_back(fmt::format("not used: {} x {}", count, what));
  if (!file.functions.empty())
    data.provenance.push_back(fmt::format("not used: {} functions (dataset 58)", file.functions.size()));
}

// ---- writing
// ------------------------------------------------------------------------------------------------

/// At most `bytes` bytes of UTF-8, on one line.
std::string cut(std::string text, std::size_t bytes) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return text.substr(0, bytes);
}

constexpr std::size_t kIdWidth = 80;

/// One polyline through all pairs: the pen is lifted where a pair does not begin at the end of the one
/// before.
UffTraceLine trace_of(const std::vector<std::array<int, 2>>& lines) {
  UffTraceLine trace{1, 1, "lines", {}};
  for (const auto& [a, b] : lines) {
    if (trace.nodes.empty() || trace.nodes.back() != a) {
      if (!trace.nodes.empty()) trace.nodes.push_back(0);
      trace.nodes.push_back(a);
    }
    trace.nodes.push_back(b);
  }
  return trace;
}

UffShape shape_of(const ModalData& data, int mode) {
  UffShape shape;
  shape.ids = {cut(data.title, kIdWidth), fmt::format("mode {} of {}", mode + 1, data.mode_count()), "NONE",
               "NONE", "NONE"};
  shape.load_case = 1;
  shape.number = mode + 1;
  shape.frequency = data.omega[mode] / (2 * std::numbers::pi);
  shape.modal_mass = std::isnan(data.modal_mass[mode]) ? 0 : data.modal_mass[mode];
  shape.viscous_damping = data.damping_ratio[mode];
  std::unordered_map<int, std::size_t> place;
  for (std::size_t k = 0; k < data.freedoms.size(); ++k) {
    const auto [found, is_new] = place.emplace(data.freedoms[k].node, shape.nodes.size());
    if (is_new) {
      shape.nodes.push_back(data.freedoms[k].node);
      shape.values.insert(shape.values.end(), 3, 0.0);
    }
    shape.values[3 * found->second + static_cast<std::size_t>(data.freedoms[k].axis)] =
        data.shapes(static_cast<Eigen::Index>(k), mode);
  }
  return shape;
}

}  // namespace

ModalData read_uff_modal_data(const std::filesystem::path& path, UffShapeAxes axes) {
  return uff_modal_data(read_uff(path), path, axes);
}

ModalData uff_modal_data(const UffFile& file, const std::filesystem::path& path, UffShapeAxes axes) {
  const std::string where = path.string();
  UffModes modes = collect_uff_modes(file, axes, where);
  const UffScale scale = uff_scale(file.units);
  ModalData data;
  data.title = title_of(file, path);
  data.provenance = {origin_of(file, path), scale.provenance};
  put_positions(file, scale, where, data);
  put_lines(file, data);
  data.freedoms = std::move(modes.freedoms);
  data.omega = std::move(modes.omega);
  data.damping_ratio = std::move(modes.damping_ratio);
  data.modal_mass = scale.kilogram() * modes.modal_mass;
  data.shapes = std::move(modes.shapes);
  data.provenance.insert(data.provenance.end(), modes.provenance.begin(), modes.provenance.end());
  say_unused(file, data);
  data.validate();
  return data;
}

void write_uff_modal_data(const std::filesystem::path& path, const ModalData& data) {
  data.validate();
  UffFile file;
  file.header.emplace();
  file.header->model = cut(data.title, kIdWidth);
  file.header->program = fmt::format("wishbone {}", kVersion);
  file.units = {1, "SI: m, N", 2, 1, 1, 1, 273.15};
  for (int i = 0; i < data.node_count(); ++i)
    file.nodes.push_back({data.node_ids[static_cast<std::size_t>(i)], 0, 0, 1, data.node_position.col(i)});
  if (!data.lines.empty()) file.trace_lines.push_back(trace_of(data.lines));
  for (int j = 0; j < data.mode_count(); ++j) file.shapes.push_back(shape_of(data, j));
  write_uff(path, file);
}

}  // namespace wishbone
