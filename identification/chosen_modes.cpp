#include "identification/chosen_modes.h"

#include <fmt/format.h>

#include <numeric>

#include "core/error.h"

namespace wishbone {
namespace {

using Eigen::Index;

Index wanted(const ModeChoice& choice, Index all, const std::function<Index(double)>& count_below) {
  if (const auto* lowest = std::get_if<LowestModes>(&choice)) return lowest->count;
  if (const auto* listed = std::get_if<ListedModes>(&choice))
    return listed->numbers.empty() ? 0 : listed->numbers.back();
  if (const auto* below = std::get_if<ModesBelow>(&choice)) return count_below(below->omega);
  return all;
}

/// 0-based.
std::vector<Index> chosen_columns(const ModeChoice& choice, const Modes& modes, std::string_view which) {
  std::vector<Index> chosen;
  if (const auto* listed = std::get_if<ListedModes>(&choice)) {
    for (const int number : listed->numbers) {
      if (number < 1 || number > modes.count())
        throw InputError({"flexible body", fmt::format("the body has {} {}", modes.count(), which),
                          fmt::format("mode {}", number), "list modes that it has"});
      chosen.push_back(number - 1);
    }
    return chosen;
  }
  Index count = modes.count();
  if (const auto* lowest = std::get_if<LowestModes>(&choice)) count = lowest->count;
  if (const auto* below = std::get_if<ModesBelow>(&choice))
    count = (modes.lambda.array() < below->omega * below->omega).count();
  chosen.resize(static_cast<std::size_t>(count));
  std::iota(chosen.begin(), chosen.end(), Index{0});
  return chosen;
}

}  // namespace

Index lowest_needed(const ModeChoice& choice, Index all, const std::function<Index(double)>& count_below,
                    std::string_view which) {
  const Index needed = wanted(choice, all, count_below);
  if (needed > all)
    throw InputError({"flexible body", fmt::format("the body has {} {}", all, which),
                      fmt::format("{} wanted", needed), "choose fewer"});
  return needed;
}

Modes chosen_modes(const ModeChoice& choice, const Modes& lowest, std::string_view which) {
  const std::vector<Index> chosen = chosen_columns(choice, lowest, which);
  return {lowest.lambda(chosen), lowest.shapes(Eigen::all, chosen)};
}

}  // namespace wishbone
