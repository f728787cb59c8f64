#include "app/comparison.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace wishbone {

namespace {

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
      for (const Section::Entry& entry : section.entries)
        if (entry.channel.path == path)
          result.differences.push_back(difference(entry.channel, in_a->units, result.common_time.time(),
                                                  values_a.col(entry.channel.component),
                                                  values_b.col(entry.channel.component)));
  }
  return result;
}

}  // namespace wishbone
