#pragma once

#include <algorithm>
#include <ctime>
#include <functional>

namespace wishbone::bench {

/// CPU seconds of `work`, the smallest of 3 to 100 repetitions that last half a second in all: minima hold within a few percent
/// where means do not. `work` returns whether it went well; a failure is not repeated.
inline double least_cpu_seconds(const std::function<bool()>& work) {
  double best = 1e300, spent = 0;
  for (int repetition = 0; repetition < 3 || (repetition < 100 && spent < 0.5); ++repetition) {
    const std::clock_t start = std::clock();
    const bool went_well = work();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    best = std::min(best, seconds);
    spent += seconds;
    if (!went_well) break;
  }
  return best;
}

}  // namespace wishbone::bench
