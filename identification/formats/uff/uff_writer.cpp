#include "identification/formats/uff/uff_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/error.h"
#include "identification/formats/uff/uff_elements.h"
#include "identification/formats/uff/uff_output.h"

namespace wishbone {
namespace {

void write(UffOutput& out, const UffHeader& header) {
  out.begin_dataset("151");
  for (const std::string* text : {&header.model, &header.description, &header.database_program,
                                  &header.created, &header.saved, &header.program, &header.written})
    out.text(*text);
  out.end_dataset();
}

void write(UffOutput& out, const UffUnits& units) {
  out.begin_dataset("164");
  out.line(fmt::format("{:10}{:<20.20}{:10}", units.code, units.description, units.temperature_mode));
  out.line(d25(units.length) + d25(units.force) + d25(units.temperature));
  out.line(d25(units.temperature_offset));
  out.end_dataset();
}

void write(UffOutput& out, const std::vector<UffCoordinateSystem>& systems) {
  if (systems.empty()) return;
  out.begin_dataset("18");
  for (const UffCoordinateSystem& system : systems) {
    out.integers(std::array{system.number, system.type, system.reference, system.color, 1}, 5);
    out.text(system.name);
    const Vector3 on_x = system.origin + system.axes.col(0), on_xz = system.origin + system.axes.col(2);
    std::array<double, 9> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      points[i] = system.origin[row], points[3 + i] = on_x[row], points[6 + i] = on_xz[row];
    }
    out.reals(points);
  }
  out.end_dataset();
}

void check_system(const UffNode& node) {
  if (node.definition_system != 0)
    throw InputError({"Universal File", "dataset 2411 has positions in the part's system only",
                      fmt::format("node {} in system {}", node.number, node.definition_system),
                      "write nodes as dataset 781 or 15"});
}

void write(UffOutput& out, const std::vector<UffNode>& nodes, UffNodeDataset dataset) {
  if (nodes.empty()) return;
  const bool is_15 = dataset == UffNodeDataset::k15, is_2411 = dataset == UffNodeDataset::k2411;
  out.begin_dataset(is_15 ? "15" : is_2411 ? "2411" : "781");
  for (const UffNode& node : nodes) {
    const std::string numbers = fmt::format("{:10}{:10}{:10}{:10}", node.number,
                                            is_2411 ? node.export_system : node.definition_system,
                                            node.displacement_system, node.color);
    const Vector3& p = node.position;
    if (is_15) {
      out.line(numbers + e13(p.x()) + e13(p.y()) + e13(p.z()));
      continue;
    }
    out.line(numbers);
    out.line(d25(p.x()) + d25(p.y()) + d25(p.z()));
  }
  out.end_dataset();
}

void write(UffOutput& out, const std::vector<UffElement>& elements) {
  if (elements.empty()) return;
  out.begin_dataset("2412");
  for (const UffElement& element : elements) {
    out.integers(std::array{element.number, element.descriptor, element.physical_property,
                            element.material_property, element.color, static_cast<int>(element.nodes.size())},
                 6);
    if (is_uff_beam(element.descriptor)) out.integers(std::array{0, 0, 0}, 3);
    out.integers(element.nodes, 8);
  }
  out.end_dataset();
}

void write(UffOutput& out, const UffTraceLine& trace) {
  out.begin_dataset("82");
  out.integers(std::array{trace.number, static_cast<int>(trace.nodes.size()), trace.color}, 3);
  out.text(trace.name);
  out.integers(trace.nodes, 8);
  out.end_dataset();
}

void check_shape(const UffShape& shape) {
  const std::size_t per_node = static_cast<std::size_t>(shape.values_per_node) * (shape.is_complex ? 2 : 1);
  if (shape.values_per_node < 1 || shape.values.size() != shape.nodes.size() * per_node)
    throw InputError({"Universal File", fmt::format("a shape needs {} values at each node", per_node),
                      fmt::format("{} values at {} nodes", shape.values.size(), shape.nodes.size()),
                      "give every node its share"});
  if (shape.dataset != 55 && shape.dataset != 2414)
    throw InputError({"Universal File", "a shape is dataset 55 or 2414", fmt::format("{}", shape.dataset),
                      "choose one of them"});
}

void write_nodal_values(UffOutput& out, const UffShape& shape) {
  const std::size_t per_node = static_cast<std::size_t>(shape.values_per_node) * (shape.is_complex ? 2 : 1);
  for (std::size_t i = 0; i < shape.nodes.size(); ++i) {
    out.integers(std::array{shape.nodes[i]}, 1);
    out.reals(std::span(shape.values).subspan(i * per_node, per_node));
  }
}

/// Records 7 and 8 of dataset 55: integers and reals of the kind of analysis.
void write_analysis(UffOutput& out, const UffShape& s) {
  std::vector<int> integers = {s.load_case, s.number};
  std::vector<double> reals;
  if (s.analysis == kUffNormalMode) {
    reals = {s.frequency, s.modal_mass, s.viscous_damping, s.hysteretic_damping};
  } else if (s.analysis == kUffComplexModeFirstOrder || s.analysis == kUffComplexModeSecondOrder) {
    reals = {s.eigenvalue.real(), s.eigenvalue.imag(), s.modal_a.real(),
             s.modal_a.imag(),    s.modal_b.real(),    s.modal_b.imag()};
  } else if (s.analysis == kUffTransient || s.analysis == kUffFrequencyResponse) {
    reals = {s.analysis == kUffTransient ? s.time : s.frequency};
  } else {
    integers.resize(1);
    reals = {s.analysis == kUffBuckling ? s.eigenvalue.real() : 0.0};
  }
  integers.insert(integers.begin(), {static_cast<int>(integers.size()), static_cast<int>(reals.size())});
  out.integers(integers, 8);
  out.reals(reals);
}

void write_definition(UffOutput& out, const UffShape& s) {
  out.integers(
      std::array{s.model, s.analysis, s.characteristic, s.quantity, s.is_complex ? 5 : 2, s.values_per_node},
      6);
}

void write_data_at_nodes(UffOutput& out, const UffShape& shape) {
  out.begin_dataset("55");
  for (const std::string& id : shape.ids) out.text(id);
  write_definition(out, shape);
  write_analysis(out, shape);
  write_nodal_values(out, shape);
  out.end_dataset();
}

void write_analysis_data(UffOutput& out, const UffShape& s) {
  out.begin_dataset("2414");
  out.integers(std::array{s.label}, 1);
  out.text(s.name);
  out.integers(std::array{1}, 1);
  for (const std::string& id : s.ids) out.text(id);
  write_definition(out, s);
  const bool in_time = s.analysis == kUffTransient, in_frequency = s.analysis == kUffFrequencyResponse;
  const bool is_mode = !in_time && !in_frequency;
  out.integers(std::array{0, 0, 1, 0, s.load_case, is_mode ? s.number : 0, in_time ? s.number : 0,
                          in_frequency ? s.number : 0},
               8);
  out.integers(std::array{0, 0}, 2);
  const bool is_complex_mode =
      s.analysis == kUffComplexModeFirstOrder || s.analysis == kUffComplexModeSecondOrder;
  const std::complex<double> root = is_complex_mode ? s.eigenvalue : 0.0;
  out.reals(std::array{s.time, s.frequency, is_complex_mode ? 0.0 : s.eigenvalue.real(), s.modal_mass,
                       s.viscous_damping, s.hysteretic_damping});
  out.reals(std::array{root.real(), root.imag(), s.modal_a.real(), s.modal_a.imag(), s.modal_b.real(),
                       s.modal_b.imag()});
  write_nodal_values(out, s);
  out.end_dataset();
}

}  // namespace

void write_uff(const std::filesystem::path& path, const UffFile& file) {
  std::for_each(file.shapes.begin(), file.shapes.end(), check_shape);
  if (file.node_dataset == UffNodeDataset::k2411)
    std::for_each(file.nodes.begin(), file.nodes.end(), check_system);
  UffOutput out(path);
  if (file.header) write(out, *file.header);
  if (file.units) write(out, *file.units);
  write(out, file.coordinate_systems);
  write(out, file.nodes, file.node_dataset);
  write(out, file.elements);
  for (const UffTraceLine& trace : file.trace_lines) write(out, trace);
  for (const UffShape& shape : file.shapes)
    shape.dataset == 55 ? write_data_at_nodes(out, shape) : write_analysis_data(out, shape);
  for (const UffFunction& function : file.functions) write_uff_function(out, function);
  out.close();
}

}  // namespace wishbone
