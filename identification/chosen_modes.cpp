#include "identification/chosen_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

std::vector<double> split_frequencies(const std::vector<Index>& chosen, const Modes& modes) {
  constexpr double kEqual = 1e-6;  // of an eigenvalue
  const auto is_chosen = [&](Index j) { return std::binary_search(chosen.begin(), chosen.end(), j); };
  std::vector<double> split;
  for (Index j = 0; j + 1 < modes.count(); ++j) {
    const double gap = modes.lambda[j + 1] - modes.lambda[j];
    if (is_chosen(j) != is_chosen(j + 1) && gap <= kEqual * modes.lambda[j + 1])
      split.push_back(std::sqrt(modes.lambda[j]));
  }
  return split;
}

}  // namespace

Index lowest_needed(const ModeChoice& choice, Index all, const std::function<Index(double)>& count_below,
                    std::string_view which) {
  const Index needed = wanted(choice, all, count_below);
  if (needed > all)
    throw InputError({"flexible body", fmt::format("the body has {} {}", all, which),
                      fmt::format("{} wanted", needed), "choose fewer"});
  if (needed == 0 || std::holds_alternative<ModesBelow>(choice)) return needed;
  return std::min(needed + 1, all);
}

ChosenModes chosen_modes(const ModeChoice& choice, const Modes& lowest, std::string_view which) {
  const std::vector<Index> chosen = chosen_columns(choice, lowest, which);
  return {{lowest.lambda(chosen), lowest.shapes(Eigen::all, chosen)}, split_frequencies(chosen, lowest)};
}

}  // namespace wishbone
