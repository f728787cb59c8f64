#include "app/modal_summary.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "app/meta_text.h"
#include "app/text_table.h"
#include "app/warnings.h"
#include "identification/formats/modal_file.h"
#include "identification/formats/mode_file.h"
#include "identification/judgement/body_extent.h"

namespace wishbone {

namespace {

double hertz(double omega) {
  return omega / (2 * std::numbers::pi);
}

std::string text_of(const Vector3& u) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", u.x(), u.y(), u.z());
}

void print_modes(const ModalData& data) {
  TextTable table({"mode", "frequency [Hz]", "damping [%]", "modal mass [kg]"}, 1);
  for (int j = 0; j < data.mode_count(); ++j)
    table.add_row({std::to_string(j + 1), fmt::format("{:.6g}", hertz(data.omega[j])),
                   brief(100 * data.damping_ratio[j]),
                   std::isnan(data.modal_mass[j]) ? "unknown" : brief(data.modal_mass[j])});
  fmt::print("\n{}", table.text());
}

void print_support(const Support& support) {
  fmt::print("\nsupport: {}\n", describe_support(support));
  for (const auto& spring : support.springs)
    fmt::print("  spring at node {} along {}: {:.6g} N/m\n", spring.node, text_of(spring.direction),
               spring.stiffness);
  for (const auto& joint : support.joints)
    fmt::print("  joint at node {} along {}\n", joint.node, text_of(joint.direction));
  for (const auto& mass : support.masses) fmt::print("  mass at node {}: {:.6g} kg\n", mass.node, mass.mass);
}

nlohmann::ordered_json json_of(const Vector3& u) {
  return {u.x(), u.y(), u.z()};
}

nlohmann::ordered_json json_of(const BodyExtent& extent) {
  nlohmann::ordered_json out{{"size", json_of(extent.size)}};
  if (!(extent.mass > 0)) return out;
  out["mass"] = extent.mass;
  out["mass_centre"] = json_of(extent.centre);
  out["inertia"] = {json_of(extent.inertia.col(0)), json_of(extent.inertia.col(1)),
                    json_of(extent.inertia.col(2))};
  return out;
}

nlohmann::ordered_json json_of(const Support& support) {
  nlohmann::ordered_json out{{"springs", nlohmann::json::array()},
                             {"joints", nlohmann::json::array()},
                             {"masses", nlohmann::json::array()}};
  for (const auto& spring : support.springs)
    out["springs"].push_back(
        {{"node", spring.node}, {"direction", json_of(spring.direction)}, {"stiffness", spring.stiffness}});
  for (const auto& joint : support.joints)
    out["joints"].push_back({{"node", joint.node}, {"direction", json_of(joint.direction)}});
  for (const auto& mass : support.masses) out["masses"].push_back({{"node", mass.node}, {"mass", mass.mass}});
  return out;
}

}  // namespace

void print_extent(const ModalData& data) {
  fmt::print("understood: {}\n", describe(body_extent(data)));
}

void warn_of_units(const std::string& file, const ModalData& data) {
  auto doubt = doubt_of_units(body_extent(data), data.mode_count() > 0 ? data.omega[0] : 0);
  if (!doubt) return;
  doubt->where = file;
  print_warnings({*doubt});
}

std::string brief(const ModalData& data) {
  std::string text = fmt::format("{} nodes, {} freedoms, {} modes", data.node_count(), data.freedom_count(),
                                 data.mode_count());
  if (data.mode_count() > 0)
    text += fmt::format(" from {} Hz to {} Hz", brief(hertz(data.omega[0])),
                        brief(hertz(data.omega[data.mode_count() - 1])));
  return text + ", " + describe_support(data.support);
}

void write_and_tell(const std::string& path, const ModalData& data) {
  write_modal_data(path, data);
  fmt::print("{}: {}\n", path, brief(data));
  if (const auto lost = lost_in_modal_data(path, data); !lost.empty())
    fmt::print("left out, for the format has no place for it: {}\n", fmt::join(lost, ", "));
}

void print_modal_data(const ModalData& data) {
  if (!data.title.empty()) fmt::print("title: {}\n", data.title);
  fmt::print("{} nodes{}, {} freedoms{}, {} modes, {} lines\n", data.node_count(),
             data.has_masses() ? fmt::format(" with {:.6g} kg", data.node_mass.sum()) : "",
             data.freedom_count(), data.is_complete() ? " (all)" : "", data.mode_count(), data.lines.size());
  print_extent(data);
  if (data.mode_count() > 0) print_modes(data);
  print_support(data.support);
  fmt::print("\nprovenance{}\n", data.provenance.empty() ? ": unknown" : "");
  for (const std::string& line : data.provenance) fmt::print("  {}\n", line);
}

nlohmann::ordered_json json_of(const ModalData& data) {
  nlohmann::ordered_json out{
      {"title", data.title},
      {"nodes", data.node_count()},
      {"freedoms", data.freedom_count()},
      {"mass", data.has_masses() ? nlohmann::json(data.node_mass.sum()) : nlohmann::json()},
      {"lines", data.lines.size()},
      {"understood", json_of(body_extent(data))}};
  out["modes"] = nlohmann::json::array();
  for (int j = 0; j < data.mode_count(); ++j)
    out["modes"].push_back({{"frequency_hz", hertz(data.omega[j])},
                            {"damping_ratio", data.damping_ratio[j]},
                            {"modal_mass", json_number(data.modal_mass[j])}});
  out["support"] = json_of(data.support);
  out["provenance"] = data.provenance;
  return out;
}

}  // namespace wishbone
