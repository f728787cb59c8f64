#pragma once

#include <array>
#include <limits>

#include "core/spatial.h"

namespace wishbone::testing {

/// f'(0) of a smooth vector function of one number by central differences with the steps h, h/2, h/4, ..., extrapolated to
/// no step at all; of every entry the value is taken that the tableau gives the smallest error [Ridders 1982]. With steps
/// as wide as f is smooth it has all but two or three digits.
template <class F>
VectorX richardson(F&& f, double h) {
  constexpr int kLevels = 5;
  std::array<VectorX, kLevels> last, next;
  VectorX best, least_error;
  for (int level = 0; level < kLevels; ++level, h /= 2) {
    const VectorX ahead = f(h), behind = f(-h);
    next[0] = (ahead - behind) / (2 * h);
    if (level == 0) {
      best = next[0];
      least_error = VectorX::Constant(best.size(), std::numeric_limits<double>::infinity());
    }
    double factor = 1;
    for (int j = 1; j <= level; ++j) {
      factor *= 4;
      next[j] = (factor * next[j - 1] - last[j - 1]) / (factor - 1);
      const VectorX error = (next[j] - next[j - 1]).cwiseAbs().cwiseMax((next[j] - last[j - 1]).cwiseAbs());
      for (Eigen::Index i = 0; i < best.size(); ++i)
        if (error[i] < least_error[i]) {
          least_error[i] = error[i];
          best[i] = next[j][i];
        }
    }
    std::swap(last, next);
  }
  return best;
}

}  // namespace wishbone::testing
