#include "core/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>

namespace wishbone {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before_last(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      // d(i,j) = min(d(i-1,j) + 1, d(i,j-1) + 1, d(i-1,j-1) + [a_i != b_j], d(i-2,j-2) + 1 if swapped)
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[n];
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates,
                         std::string_view kind) {
  if (candidates.empty()) return "there are none";
  constexpr std::size_t kLongestWord = 100;  // beyond it the quadratic distance is not worth its time
  if (name.size() <= kLongestWord) {
    const auto nearest = std::min_element(
        candidates.begin(), candidates.end(),
        [&](const auto& a, const auto& b) { return edit_distance(name, a) < edit_distance(name, b); });
    const int shorter = static_cast<int>(std::min(name.size(), nearest->size()));
    const int distance = edit_distance(name, *nearest);
    if (distance <= std::max(1, shorter / 3) && distance < shorter)
      return fmt::format("did you mean '{}'?", *nearest);
  }
  constexpr std::size_t kMostListed = 30;
  const std::vector<std::string> listed(candidates.begin(),
                                        candidates.begin() + std::min(candidates.size(), kMostListed));
  return fmt::format("{} are: {}{}", kind, fmt::join(listed, ", "),
                     candidates.size() > kMostListed ? ", ..." : "");
}

}  // namespace wishbone
