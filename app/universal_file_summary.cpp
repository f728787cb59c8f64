#include "app/universal_file_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numbers>
#include <string>
#include <string_view>

#include "app/meta_text.h"
#include "app/text_table.h"
#include "core/utf8.h"
#include "identification/formats/uff/uff_mode_sets.h"
#include "identification/formats/uff/uff_modes.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {

namespace {

/// Kinds of nodal results (UffAnalysis).
std::string analysis_name(int analysis) {
  constexpr std::array<std::string_view, 8> kNames{"unknown",     "static",
                                                   "normal mode", "complex mode",
                                                   "transient",   "frequency response",
                                                   "buckling",    "complex mode (second order)"};
  const auto index = static_cast<std::size_t>(analysis);
  return analysis >= 0 && index < kNames.size() ? std::string(kNames[index]) : std::to_string(analysis);
}

/// Kinds of functions: record 6, field 1 of the specification of dataset 58.
std::string function_name(int type) {
  constexpr std::array<std::string_view, 7> kNames{"general",        "time response",      "auto spectrum",
                                                   "cross spectrum", "frequency response", "transmissibility",
                                                   "coherence"};
  const auto index = static_cast<std::size_t>(type);
  return type >= 0 && index < kNames.size() ? std::string(kNames[index]) : fmt::format("type {}", type);
}

/// "12 -x", "12 rz", "12" for a scalar.
std::string text_of(const UffFreedom& freedom) {
  constexpr std::array<std::string_view, 7> kAxes{"", "x", "y", "z", "rx", "ry", "rz"};
  const auto axis = static_cast<std::size_t>(std::abs(freedom.direction));
  if (axis == 0 || axis >= kAxes.size()) return std::to_string(freedom.node);
  return fmt::format("{} {}{}", freedom.node, freedom.direction < 0 ? "-" : "", kAxes[axis]);
}

double hertz(double omega) {
  return omega / (2 * std::numbers::pi);
}

void print_shapes(const UffFile& file) {
  if (file.shapes.empty()) return;
  TextTable table(
      {"nodal result", "dataset", "line", "number", "frequency [Hz]", "damping [%]", "nodes", "values each"},
      1);
  for (const UffShape& shape : file.shapes) {
    const UffOscillation oscillation = uff_oscillation(shape);
    table.add_row({analysis_name(shape.analysis), std::to_string(shape.dataset), std::to_string(shape.line),
                   std::to_string(shape.number), brief(hertz(oscillation.omega)),
                   brief(100 * oscillation.damping_ratio), std::to_string(shape.nodes.size()),
                   fmt::format("{}{}", shape.values_per_node, shape.is_complex ? " complex" : "")});
  }
  fmt::print("\n{}", table.text());
}

void print_functions(const UffFile& file) {
  constexpr std::size_t kShown = 40;
  if (file.functions.empty()) return;
  TextTable table({"function", "response", "reference", "storage", "points", "first", "step"}, 4);
  for (std::size_t i = 0; i < std::min(kShown, file.functions.size()); ++i) {
    const UffFunction& f = file.functions[i];
    table.add_row({function_name(f.type), text_of(f.response), text_of(f.reference),
                   f.is_binary ? "58b" : "58", std::to_string(f.point_count()),
                   brief(f.is_even || f.abscissa.empty() ? f.abscissa_start : f.abscissa.front()),
                   f.is_even ? brief(f.abscissa_step) : "uneven"});
  }
  fmt::print("\n{}", table.text());
  if (file.functions.size() > kShown)
    fmt::print("and {} more (--json shows all)\n", file.functions.size() - kShown);
}

nlohmann::ordered_json json_of(const UffShape& shape) {
  const UffOscillation oscillation = uff_oscillation(shape);
  return {{"analysis", analysis_name(shape.analysis)},
          {"dataset", shape.dataset},
          {"line", shape.line},
          {"number", shape.number},
          {"frequency_hz", json_number(hertz(oscillation.omega))},
          {"damping_ratio", json_number(oscillation.damping_ratio)},
          {"nodes", shape.nodes.size()},
          {"values_per_node", shape.values_per_node},
          {"complex", shape.is_complex}};
}

nlohmann::ordered_json json_of(const UffFunction& f) {
  return {{"type", function_name(f.type)},
          {"response", text_of(f.response)},
          {"reference", text_of(f.reference)},
          {"binary", f.is_binary},
          {"complex", f.is_complex},
          {"points", f.point_count()},
          {"even", f.is_even}};
}

}  // namespace

void print_universal_file(const UffFile& file) {
  const auto print_origin = [](std::string_view what, const std::string& text) {
    if (!text.empty()) fmt::print("{}: {}\n", what, as_utf8(text));
  };
  if (file.header) {
    print_origin("model", file.header->model);
    print_origin("written by", file.header->program);
  }
  if (file.units)
    fmt::print("units: {} ({:g} per m, {:g} per N)\n", as_utf8(file.units->description), file.units->length,
               file.units->force);
  else
    fmt::print("units: not told\n");
  fmt::print("{}\n", describe(file));
  print_shapes(file);
  print_functions(file);
  if (file.unused.empty()) return;
  TextTable table({"not read", "line", "why"}, 3);
  for (const UffUnused& unused : file.unused)
    table.add_row({fmt::format("dataset {}", unused.dataset), std::to_string(unused.line), unused.why});
  fmt::print("\n{}", table.text());
}

nlohmann::ordered_json json_of(const UffFile& file) {
  nlohmann::ordered_json out{{"nodes", file.nodes.size()},
                             {"coordinate_systems", file.coordinate_systems.size()},
                             {"trace_lines", file.trace_lines.size()},
                             {"elements", file.elements.size()}};
  out["nodal_results"] = nlohmann::ordered_json::array();
  for (const UffShape& shape : file.shapes) out["nodal_results"].push_back(json_of(shape));
  out["functions"] = nlohmann::ordered_json::array();
  for (const UffFunction& function : file.functions) out["functions"].push_back(json_of(function));
  out["not_read"] = nlohmann::ordered_json::array();
  for (const UffUnused& unused : file.unused)
    out["not_read"].push_back({{"dataset", unused.dataset}, {"line", unused.line}, {"why", unused.why}});
  return out;
}

}  // namespace wishbone
