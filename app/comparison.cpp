#include "app/comparison.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "app/glob.h"
#include "core/error.h"

namespace wishbone {

namespace {

/// A line of the report on a vehicle: which signals stand under which heading, and what to call them.
/// `components` maps the components shown to their titles; empty: all components under their own names.
struct ReportLine {
  std::string heading;
  std::string glob;
  std::map<std::string, std::string> components;
};

const std::vector<ReportLine>& vehicle_report() {
  static const std::vector<ReportLine> lines{
      {"Path of the chassis", "/vehicle/*_position", {}},
      {"Vehicle motion", "/vehicle/*rate*", {}},
      {"Vehicle motion", "/vehicle/*slip*", {}},
      {"Vehicle motion", "/vehicle/*velocity*", {}},
      {"Steering", "/vehicle/*steer*", {}},
      {"Vehicle motion", "/vehicle/*", {}},
      {"Tire deflection", "/tires/*/deflection", {}},
  };
  return lines;
}

constexpr const char* kDeflections = "/flexible/*/deflection";
constexpr int kNodesShown = 2;

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

/// Signals of both files by path; A's description where both have it.
std::map<std::string, Signal> union_of_signals(const ResultFile& a, const ResultFile& b) {
  std::map<std::string, Signal> all;
  for (const ResultFile* file : {&a, &b})
    for (const Signal& signal : file->signals()) all.emplace(signal.path, signal);
  return all;
}

class SectionList {
 public:
  void add(const std::string& heading, const std::string& title, const Channel& channel) {
    auto found = std::find_if(sections_.begin(), sections_.end(),
                              [&](const Section& s) { return s.heading == heading; });
    if (found == sections_.end()) found = sections_.insert(found, Section{heading, {}});
    found->entries.push_back({title, channel});
  }
  std::vector<Section> take() { return std::move(sections_); }

 private:
  std::vector<Section> sections_;
};

/// Largest distance of each node from its undeformed place, over both files.
VectorX largest_deflections(const Signal& signal, const ResultFile& a, const ResultFile& b) {
  const int nodes = signal.shape[0];
  const int width = signal.shape[1];
  VectorX largest = VectorX::Zero(nodes);
  for (const ResultFile* file : {&a, &b}) {
    const Signal* own = file->find(signal.path);
    if (!own || own->shape != signal.shape || file->time().size() == 0) continue;
    const MatrixX u = file->read(signal.path);
    for (int n = 0; n < nodes; ++n)
      largest[n] = std::max(largest[n], u.middleCols(n * width, width).rowwise().norm().maxCoeff());
  }
  return largest;
}

void add_deflections(const Signal& signal, const ResultFile& a, const ResultFile& b, SectionList& sections) {
  if (signal.shape.size() != 2) return;
  const VectorX largest = largest_deflections(signal, a, b);
  std::vector<int> nodes(static_cast<std::size_t>(signal.shape[0]));
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<int>(i);
  std::stable_sort(nodes.begin(), nodes.end(), [&](int i, int j) { return largest[i] > largest[j]; });
  nodes.resize(std::min<std::size_t>(nodes.size(), kNodesShown));
  std::sort(nodes.begin(), nodes.end());

  const std::string body = signal.path.substr(10, signal.path.rfind('/') - 10);
  const std::vector<Channel> all = channels(signal);
  for (const int node : nodes)
    for (int i = 0; i < signal.shape[1]; ++i) {
      const Channel& channel = all[static_cast<std::size_t>(node * signal.shape[1] + i)];
      sections.add("Deflection of the " + body, capitalised(channel.name), channel);
    }
}

std::vector<Section> vehicle_sections(const std::map<std::string, Signal>& signals, const ResultFile& a,
                                      const ResultFile& b) {
  SectionList sections;
  std::set<std::string> taken;
  for (const ReportLine& line : vehicle_report())
    for (const auto& [path, signal] : signals) {
      if (!matches(line.glob, path) || !taken.insert(path).second) continue;
      for (const Channel& channel : channels(signal)) {
        const auto title = line.components.find(channel.name);
        if (title != line.components.end())
          sections.add(line.heading, title->second, channel);
        else if (line.components.empty())
          sections.add(line.heading, title_of(channel, line.heading), channel);
      }
    }
  for (const auto& [path, signal] : signals)
    if (matches(kDeflections, path)) add_deflections(signal, a, b, sections);
  return sections.take();
}

/// Signals under the name of the group they stand in.
std::vector<Section> plain_sections(const std::map<std::string, Signal>& signals,
                                    const std::vector<std::string>& globs) {
  SectionList sections;
  for (const auto& [path, signal] : signals) {
    if (!globs.empty() && !matches_any(globs, path)) continue;
    const std::string group = path.substr(1, std::max(path.find('/', 1), std::size_t{2}) - 1);
    for (const Channel& channel : channels(signal))
      sections.add(capitalised(group), title_of(channel, group), channel);
  }
  return sections.take();
}

/// Why two signals of one path cannot be subtracted; nothing when they can.
std::optional<std::string> mismatch(const Signal& a, const Signal& b) {
  if (a.shape != b.shape)
    return fmt::format("{}: rows of shape [{}] and [{}]", a.path, fmt::join(a.shape, ", "),
                       fmt::join(b.shape, ", "));
  if (a.units != b.units) return fmt::format("{}: units '{}' and '{}'", a.path, a.units, b.units);
  if (a.frame != b.frame) return fmt::format("{}: frames '{}' and '{}'", a.path, a.frame, b.frame);
  return std::nullopt;
}

/// Paths of the sections, each once, in order.
std::vector<std::string> paths_of(const std::vector<Section>& sections) {
  std::vector<std::string> paths;
  for (const Section& section : sections)
    for (const Section::Entry& entry : section.entries)
      if (std::find(paths.begin(), paths.end(), entry.channel.path) == paths.end())
        paths.push_back(entry.channel.path);
  return paths;
}

}  // namespace

std::vector<Section> choose_sections(const ResultFile& a, const ResultFile& b, const Choice& choice) {
  const std::map<std::string, Signal> signals = union_of_signals(a, b);
  if (choice.all) return plain_sections(signals, {});
  if (choice.globs.empty()) {
    std::vector<Section> sections = vehicle_sections(signals, a, b);
    return sections.empty() ? plain_sections(signals, {}) : sections;
  }
  std::vector<Section> sections = plain_sections(signals, choice.globs);
  if (sections.empty())
    throw InputError({a.path() + ", " + b.path(), "no signal matches",
                      fmt::format("{}", fmt::join(choice.globs, " ")),
                      "`wishbone info` lists the signals; quote patterns, as in --signals '/tires/*'"});
  return sections;
}

Comparison compare(const ResultFile& a, const ResultFile& b, const Choice& choice) {
  Comparison result{CommonTime(a, b), choose_sections(a, b, choice), {}, {}, {}, {}};
  for (const std::string& path : paths_of(result.sections)) {
    const Signal* in_a = a.find(path);
    const Signal* in_b = b.find(path);
    if (!in_a || !in_b) {
      (in_a ? result.only_in_a : result.only_in_b).push_back(path);
      continue;
    }
    if (const auto why = mismatch(*in_a, *in_b)) {
      result.incomparable.push_back(*why);
      continue;
    }
    const MatrixX values_a = result.common_time.of_a(a.read(path));
    const MatrixX values_b = result.common_time.of_b(b.read(path));
    for (const Section& section : result.sections)
      for (const auto& [title, channel] : section.entries)
        if (channel.path == path)
          result.differences.push_back(difference(channel, in_a->units, result.common_time.time(),
                                                  values_a.col(channel.component),
                                                  values_b.col(channel.component)));
  }
  return result;
}

}  // namespace wishbone
