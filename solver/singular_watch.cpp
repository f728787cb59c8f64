#include "solver/singular_watch.h"

#include <cmath>
#include <limits>

namespace wishbone {
namespace {

constexpr double kClose = 0.5;      // sine above which nothing is singular
constexpr double kSameSlope = 0.3;  // deviation from the mirrored line, relative
constexpr double kTouching = 1e-4;  // a step that ends here has landed on the position

}  // namespace

void SingularWatch::observe(double t, const ClosureFactor& closure) {
  const Sample now{t, closure.least_sine};
  const double slope = (last_.sine - before_.sine) / (last_.t - before_.t);
  const double mirrored = -(last_.sine + slope * (now.t - last_.t));
  const bool crossed = last_.sine < kClose && slope < 0 && mirrored > 0 &&
                       std::abs(now.sine - mirrored) < kSameSlope * (now.sine + mirrored);
  const bool landed = now.sine < kTouching && last_.sine >= kTouching;
  if (crossed && last_.sine >= kTouching)
    passages_.push_back({last_.t - last_.sine / slope, closure.least_row});
  else if (landed)
    passages_.push_back({t, closure.least_row});
  before_ = last_;
  last_ = now;
}

double SingularWatch::expected() const {
  if (last_.sine >= before_.sine || last_.sine > kClose) return std::numeric_limits<double>::infinity();
  return last_.t + last_.sine * (last_.t - before_.t) / (before_.sine - last_.sine);
}

}  // namespace wishbone
