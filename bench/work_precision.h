#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

namespace wishbone::bench {

/// One run of a work-precision table.
struct Precision {
  double tolerance = 0;
  double error = 0;  ///< infinite when the run failed
  double cpu_seconds = 0;
};

/// Least CPU time [s] that reaches `error` and keeps it at all tighter tolerances at which the run succeeds, since end-point
/// errors are not monotone in the tolerance; below zero when none does. `runs` go from loose to tight.
inline double cost_of(double error, const std::vector<Precision>& runs) {
  double least = -1;
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    if (std::isinf(run->error)) continue;
    if (run->error > error) break;
    if (least < 0 || run->cpu_seconds < least) least = run->cpu_seconds;
  }
  return least;
}

inline void print_cost_heading() {
  fmt::print("| CPU ms to reach the error | 1e-3 | 1e-4 | 1e-5 | 1e-6 |\n|---|---|---|---|---|\n");
}

inline void print_cost_row(const std::string& name, const std::vector<Precision>& runs) {
  fmt::print("| {} |", name);
  for (const double error : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const double seconds = cost_of(error, runs);
    fmt::print(" {} |", seconds < 0 ? "-" : fmt::format("{:.3g}", 1e3 * seconds));
  }
  fmt::print("\n");
}

}  // namespace wishbone::bench
