#include "app/closure_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace wishbone {
namespace {

constexpr double kRounding = 1e-11;        // [m, rad]
constexpr std::size_t kMostPassages = 10;  // listed one by one

}  // namespace

bool is_open(const ClosureGap& gap) {
  return gap.length > kRounding || gap.angle > kRounding;
}

std::string text_of(const ClosureGap& gap) {
  std::vector<std::string> parts;
  if (gap.length > kRounding) parts.push_back(fmt::format("{:.4g} m", gap.length));
  if (gap.angle > kRounding) parts.push_back(fmt::format("{:.4g} rad", gap.angle));
  return parts.empty() ? "closed" : fmt::format("{}", fmt::join(parts, ", "));
}

nlohmann::ordered_json json_of(const ClosureGap& given, const ClosureGap& closed) {
  return {{"length_before", given.length},
          {"angle_before", given.angle},
          {"length_after", closed.length},
          {"angle_after", closed.angle}};
}

std::vector<std::string> assembly_lines(const AssemblyReport& assembly) {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < assembly.gaps.size(); ++c)
    if (is_open(assembly.gaps[c]))
      lines.push_back(fmt::format("assembled: {} was open by {}, after {}", assembly.gaps[c].name,
                                  text_of(assembly.gaps[c]), text_of(assembly.closed[c])));
  return lines;
}

std::vector<std::string> passage_lines(const std::vector<NamedPassage>& passages) {
  std::vector<std::string> lines;
  for (const NamedPassage& passage : passages) {
    if (lines.size() == kMostPassages) {
      lines.push_back(fmt::format("singular positions passed: {} in all", passages.size()));
      break;
    }
    lines.push_back(fmt::format("singular position passed at t = {:.6g} s: {}", passage.t, passage.row));
  }
  return lines;
}

}  // namespace wishbone
