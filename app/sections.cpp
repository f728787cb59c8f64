#include "app/sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "app/wide_signal.h"
#include "core/error.h"
#include "core/glob.h"

namespace wishbone {

namespace {

/// A line of the report on a vehicle: which signals stand under which heading.
struct ReportLine {
  std::string heading;
  std::string glob;
};

const std::vector<ReportLine>& vehicle_report() {
  static const std::vector<ReportLine> lines{
      {"Path of the chassis", "/vehicle/*_position"},
      {"Vehicle motion", "/vehicle/*rate*"},
      {"Vehicle motion", "/vehicle/*slip*"},
      {"Vehicle motion", "/vehicle/*velocity*"},
      {"Steering", "/vehicle/*steer*"},
      {"Vehicle motion", "/vehicle/*"},
      {"Tire deflection", "/tires/*/deflection"},
  };
  return lines;
}

/// A line of the report on every flexible body or recovery; its name completes the heading, that of the component the title.
struct FlexibleLine {
  std::string heading;
  std::string glob;
  std::string title;
};

const std::vector<FlexibleLine>& flexible_report() {
  static const std::vector<FlexibleLine> lines{
      {"Deflection of the ", "/flexible/*/deflection", ""},
      {"Energy of the ", "/flexible/*/strain_energy", "strain energy"},
      {"Energy of the ", "/flexible/*/vibration_energy", "vibration energy"},
      {"Energy of the ", "/flexible/*/modal_strain_energy", "strain energy of mode "},
      {"Energy of the ", "/flexible/*/modal_kinetic_energy", "kinetic energy of mode "},
      {"Interface forces of the ", "/flexible/*/interface_force", ""},
      {"Recovered ", "/recovery/*", ""},
  };
  return lines;
}

constexpr const char* kModalEnergies = "/flexible/*/modal_*_energy";

std::string capitalised(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// "/vehicle/side_slip" -> "Side slip", "/bodies/hub/position" y -> "Hub position y". What the heading says
/// already is not repeated: "/tires/front_left/deflection" under "Tire deflection" -> "Front left".
std::string title_of(const Channel& channel, const std::string& heading) {
  std::string text =
      channel.path.substr(channel.path.find('/', 1) == std::string::npos ? 1 : channel.path.find('/', 1) + 1);
  const std::size_t leaf = text.rfind('/');
  if (leaf != std::string::npos && heading.ends_with(text.substr(leaf + 1))) text.resize(leaf);
  std::replace(text.begin(), text.end(), '/', ' ');
  return capitalised(channel.name.empty() ? text : text + " " + channel.name);
}

/// Second name of a path: "chassis" of "/flexible/chassis/deflection".
std::string owner_of(const std::string& path) {
  const std::size_t start = path.find('/', 1) + 1;
  return path.substr(start, path.find('/', start) - start);
}

/// Signals of both files by path; A's description where both have it.
std::map<std::string, Signal> union_of_signals(const ResultFile& a, const ResultFile& b) {
  std::map<std::string, Signal> all;
  for (const ResultFile* file : {&a, &b})
    for (const Signal& signal : file->signals()) all.emplace(signal.path, signal);
  return all;
}

/// The sections of two files on their way.
class SectionList {
 public:
  SectionList(const ResultFile& a, const ResultFile& b) : a_(a), b_(b) {}

  void add(const std::string& heading, const std::string& title, const Channel& channel,
           bool plotted = true) {
    section(heading).entries.push_back({title, channel, plotted});
  }
  std::vector<int> notable(const Signal& signal) const { return notable_components(signal, a_, b_); }
  /// The chart that belongs to energies of modes, to no other signal.
  void add_chart(const std::string& heading, const Signal& signal) {
    if (!matches(kModalEnergies, signal.path)) return;
    const std::string name = signal.path.substr(signal.path.rfind('/') + 1);
    section(heading).charts.push_back(
        {fmt::format("Peak of the {} of the {} by mode",
                     name == "modal_strain_energy" ? "strain energy" : "kinetic energy",
                     owner_of(signal.path)),
         signal.units,
         "mode",
         {peaks(signal, a_), peaks(signal, b_)}});
  }
  std::vector<Section> take() { return std::move(sections_); }

 private:
  Section& section(const std::string& heading) {
    auto found = std::find_if(sections_.begin(), sections_.end(),
                              [&](const Section& s) { return s.heading == heading; });
    if (found == sections_.end()) found = sections_.insert(found, Section{heading, {}, {}});
    return *found;
  }

  const ResultFile &a_, &b_;
  std::vector<Section> sections_;
};

void add_vehicle(const std::map<std::string, Signal>& signals, SectionList& sections) {
  std::set<std::string> taken;
  for (const ReportLine& line : vehicle_report())
    for (const auto& [path, signal] : signals) {
      if (!matches(line.glob, path) || !taken.insert(path).second) continue;
      for (const Channel& channel : channels(signal))
        sections.add(line.heading, title_of(channel, line.heading), channel);
    }
}

void add_flexible(const std::map<std::string, Signal>& signals, SectionList& sections) {
  for (const FlexibleLine& line : flexible_report())
    for (const auto& [path, signal] : signals) {
      if (!matches(line.glob, path)) continue;
      const std::string heading = line.heading + owner_of(path);
      const std::vector<Channel> all = channels(signal);
      for (const int i : sections.notable(signal)) {
        const Channel& channel = all[static_cast<std::size_t>(i)];
        sections.add(heading, capitalised(line.title + channel.name), channel);
      }
      sections.add_chart(heading, signal);
    }
}

/// Signals under the name of the group they stand in.
void add_groups(const std::map<std::string, Signal>& signals, const std::vector<std::string>& globs,
                SectionList& sections) {
  for (const auto& [path, signal] : signals) {
    if (!globs.empty() && !matches_any(globs, path)) continue;
    const std::string group = path.substr(1, std::max(path.find('/', 1), std::size_t{2}) - 1);
    const std::vector<int> notable = sections.notable(signal);
    for (const Channel& channel : channels(signal))
      sections.add(capitalised(group), title_of(channel, group), channel,
                   std::binary_search(notable.begin(), notable.end(), channel.component));
    sections.add_chart(capitalised(group), signal);
  }
}

}  // namespace

std::vector<Section> choose_sections(const ResultFile& a, const ResultFile& b, const Choice& choice) {
  const std::map<std::string, Signal> signals = union_of_signals(a, b);
  if (!choice.all && choice.globs.empty()) {
    SectionList report(a, b);
    add_vehicle(signals, report);
    add_flexible(signals, report);
    if (std::vector<Section> sections = report.take(); !sections.empty()) return sections;
  }
  SectionList groups(a, b);
  add_groups(signals, choice.all ? std::vector<std::string>{} : choice.globs, groups);
  std::vector<Section> sections = groups.take();
  if (sections.empty() && !choice.all && !choice.globs.empty())
    throw InputError({a.path() + ", " + b.path(), "no signal matches",
                      fmt::format("{}", fmt::join(choice.globs, " ")),
                      "`wishbone info` lists the signals; quote patterns, as in --signals '/tires/*'"});
  return sections;
}

}  // namespace wishbone
