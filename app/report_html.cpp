#include "app/report_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "app/base64.h"
#include "app/markup.h"
#include "app/meta_text.h"
#include "app/page.h"
#include "app/text_table.h"

namespace wishbone {

namespace embedded {
extern const std::string_view dygraph_css;
extern const std::string_view dygraph_js;
extern const std::string_view report_css;
extern const std::string_view report_html;
extern const std::string_view report_js;
}  // namespace embedded

namespace {

/// The unit in which people read a quantity.
struct DisplayUnit {
  std::string name;
  double factor = 1;
};

DisplayUnit display_unit(const std::string& units, double largest) {
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  constexpr double kSmallLength = 0.1;  // [m]
  if (units == "rad") return {"deg", kDegrees};
  if (units == "rad/s") return {"deg/s", kDegrees};
  if (units == "m" && largest < kSmallLength) return {"mm", 1000};
  return {units == "1" ? "" : units, 1};
}

/// A channel of one of the files; nothing when the file lacks it.
std::optional<VectorX> curve(const ResultFile& file, const Channel& channel) {
  const Signal* signal = file.find(channel.path);
  if (!signal || channel.component >= signal->size()) return std::nullopt;
  return file.read(channel.path).col(channel.component);
}

double largest(const std::optional<VectorX>& values) {
  return values && values->size() > 0 ? values->cwiseAbs().maxCoeff() : 0;
}

nlohmann::json plotted(const std::optional<VectorX>& values, double factor) {
  if (!values) return nullptr;
  const VectorX shown = factor * *values;
  return base64_of_floats({shown.data(), static_cast<std::size_t>(shown.size())});
}

const Difference* find(const Comparison& comparison, const Channel& channel) {
  const auto found =
      std::find_if(comparison.differences.begin(), comparison.differences.end(), [&](const Difference& d) {
        return d.channel.path == channel.path && d.channel.component == channel.component;
      });
  return found == comparison.differences.end() ? nullptr : &*found;
}

nlohmann::json plot_data(const ResultFile& a, const ResultFile& b, const Section::Entry& entry,
                         const Comparison& comparison) {
  const auto values_a = curve(a, entry.channel);
  const auto values_b = curve(b, entry.channel);
  const Signal* signal = a.find(entry.channel.path) ? a.find(entry.channel.path) : b.find(entry.channel.path);
  const DisplayUnit unit = display_unit(signal->units, std::max(largest(values_a), largest(values_b)));
  nlohmann::json plot{{"title", entry.title},
                      {"unit", unit.name},
                      {"a", plotted(values_a, unit.factor)},
                      {"b", plotted(values_b, unit.factor)}};
  if (const Difference* d = find(comparison, entry.channel))
    plot["note"] = d->max_difference == 0
                       ? "no difference"
                       : fmt::format("max difference {} {} at {} s", brief(unit.factor * d->max_difference),
                                     unit.name, brief(d->time_of_maximum));
  return plot;
}

/// What is left out of the plots; empty when nothing is.
std::string plot_note(const Section& section) {
  const auto plotted = std::count_if(section.entries.begin(), section.entries.end(),
                                     [](const Section::Entry& entry) { return entry.plotted; });
  const auto all = static_cast<std::ptrdiff_t>(section.entries.size());
  if (plotted == all) return "";
  return fmt::format(
      "{} of {} curves are plotted: of signals with many numbers those that become largest. The table below "
      "has all.",
      plotted, all);
}

/// Everything the page's program needs; "</" is masked so that no text can end the script element.
std::string page_data(const ReportedFile& a, const ReportedFile& b, const Comparison& comparison) {
  const auto times = [](const ResultFile& file) {
    return base64_of_floats({file.time().data(), static_cast<std::size_t>(file.time().size())});
  };
  nlohmann::json data{{"titles", {a.title, b.title}}, {"times", {times(a.file), times(b.file)}}};
  data["sections"] = nlohmann::json::array();
  for (const Section& section : comparison.sections) {
    nlohmann::json plots = nlohmann::json::array(), pictures = nlohmann::json::array();
    for (const Section::Entry& entry : section.entries)
      if (entry.plotted) plots.push_back(plot_data(a.file, b.file, entry, comparison));
    for (const PeakChart& chart : section.charts)
      pictures.push_back({{"title", chart.title}, {"unit", chart.unit}, {"svg", peak_chart_svg(chart)}});
    data["sections"].push_back({{"heading", section.heading},
                                {"note", plot_note(section)},
                                {"plots", plots},
                                {"pictures", pictures}});
  }
  std::string text = json_text(data, -1);
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at))
    text.replace(at, 2, "<\\/");
  return text;
}

std::string difference_row(const Section::Entry& entry, const Difference& d) {
  const double scale = std::max(d.max_a, d.max_b);
  const DisplayUnit unit = display_unit(d.units, scale);
  std::string cells;
  for (const double value : {d.max_a, d.max_b, d.max_difference, d.rms_difference})
    cells += fmt::format("<td>{}</td>", brief(unit.factor * value));
  const std::string share = scale > 0 ? fmt::format("{:.2g} %", 100 * d.max_difference / scale) : "0 %";
  return fmt::format("<tr><td>{}<small>{}</small></td><td class=unit>{}</td>{}<td>{}</td><td>{}</td></tr>\n",
                     escape_markup(entry.title), escape_markup(d.channel.text()), escape_markup(unit.name),
                     cells, share, brief(d.time_of_maximum));
}

std::string difference_table(const Comparison& comparison) {
  std::string rows;
  for (const Section& section : comparison.sections) {
    std::string of_section;
    for (const Section::Entry& entry : section.entries)
      if (const Difference* d = find(comparison, entry.channel)) of_section += difference_row(entry, *d);
    if (!of_section.empty())
      rows += fmt::format("<tr class=heading><th colspan=8>{}</th></tr>\n", escape_markup(section.heading)) +
              of_section;
  }
  return rows;
}

std::string notes(const ReportedFile& a, const ReportedFile& b, const Comparison& comparison) {
  std::vector<std::string> lines;
  for (const ReportedFile* reported : {&a, &b})
    if (const std::string status = reported->file.status(); status != "complete")
      lines.push_back(fmt::format("The run of {} is not complete: {}.", reported->title,
                                  status.empty() ? "the file does not tell its status" : status));
  const auto list = [&](const std::string& title, const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    std::string joined;
    for (const std::string& path : paths) joined += (joined.empty() ? "" : ", ") + path;
    lines.push_back(title + ": " + joined + ".");
  };
  list("Only in " + a.title, comparison.only_in_a);
  list("Only in " + b.title, comparison.only_in_b);
  list("Not comparable", comparison.incomparable);
  std::string html;
  for (const std::string& line : lines) html += "<li>" + escape_markup(line) + "</li>\n";
  return html;
}

std::string meta_cell(const std::map<std::string, hdf5::Value>& meta, const std::string& name) {
  const auto found = meta.find(name);
  if (found == meta.end()) return "<td class=none>none</td>";
  const std::string text = text_of(found->second);
  if (text.find('\n') == std::string::npos) return "<td>" + escape_markup(text) + "</td>";
  return fmt::format("<td><details><summary>{} lines</summary><pre>{}</pre></details></td>",
                     std::count(text.begin(), text.end(), '\n'), escape_markup(text));
}

/// Facts of both runs side by side; rows in which they differ are marked.
std::string meta_rows(const std::map<std::string, hdf5::Value>& a,
                      const std::map<std::string, hdf5::Value>& b) {
  std::map<std::string, hdf5::Value> names = a;
  names.insert(b.begin(), b.end());
  std::string rows;
  for (const auto& [name, value] : names) {
    const std::string cell_a = meta_cell(a, name);
    const std::string cell_b = meta_cell(b, name);
    rows += fmt::format("<tr{}><th>{}</th>{}{}</tr>\n", cell_a == cell_b ? "" : " class=differs",
                        escape_markup(name), cell_a, cell_b);
  }
  return rows;
}

}  // namespace

std::string report_html(const ReportedFile& a, const ReportedFile& b, const Comparison& comparison) {
  // Browsers would look for the source map next to the page.
  const auto without_map = [](std::string_view text) {
    return std::string(
        text.substr(0, std::min(text.rfind("//# sourceMappingURL"), text.rfind("/*# sourceMappingURL"))));
  };
  return filled(embedded::report_html, {{"dygraph_css", without_map(embedded::dygraph_css)},
                                        {"dygraph_js", without_map(embedded::dygraph_js)},
                                        {"report_css", std::string(embedded::report_css)},
                                        {"report_js", std::string(embedded::report_js)},
                                        {"title_a", escape_markup(a.title)},
                                        {"title_b", escape_markup(b.title)},
                                        {"file_a", escape_markup(a.file.path())},
                                        {"file_b", escape_markup(b.file.path())},
                                        {"compared", escape_markup(comparison.common_time.text())},
                                        {"notes", notes(a, b, comparison)},
                                        {"differences", difference_table(comparison)},
                                        {"meta", meta_rows(a.file.meta(), b.file.meta())},
                                        {"run_meta", meta_rows(a.file.run_meta(), b.file.run_meta())},
                                        {"data", page_data(a, b, comparison)}});
}

}  // namespace wishbone
