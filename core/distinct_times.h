#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace wishbone {

/// The times in ascending order, each once. Those that differ by rounding alone are one: no integrator can step between them.
inline std::vector<double> distinct_times(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const auto same = [](double a, double b) { return b - a <= 1e-12 * std::max(1.0, std::abs(b)); };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

}  // namespace wishbone
