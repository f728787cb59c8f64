#include "solver/singular_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wishbone {
namespace {

constexpr double kClose = 0.5;      // sine above which nothing is singular
constexpr double kSameSlope = 0.3;  // deviation from the mirrored line, relative
constexpr double kSameFall = 0.5;   // deviation of one slope of the fall from the one before, relative
constexpr double kTouching = 1e-4;  // a step that ends here has landed on the position,
constexpr double kFallen = 1e-2;    // if the sine was so much larger before

double slope_between(double t0, double sine0, double t1, double sine1) {
  return (sine1 - sine0) / (t1 - t0);
}

}  // namespace

void SingularWatch::observe(double t, const ClosureFactor& closure) {
  const Sample now{t, closure.least_sine};
  highest_ = std::max(highest_, now.sine);
  const double slope = slope_between(before_.t, before_.sine, last_.t, last_.sine);
  const double mirrored = -(last_.sine + slope * (now.t - last_.t));
  const bool crossed = last_.sine < kClose && falls_along_a_line() && mirrored > 0 &&
                       std::abs(now.sine - mirrored) < kSameSlope * (now.sine + mirrored);
  const bool landed = now.sine < kTouching && last_.sine >= kTouching && now.sine < kFallen * highest_;
  if (crossed && last_.sine >= kTouching)
    passages_.push_back({last_.t - last_.sine / slope, closure.least_row});
  else if (landed)
    passages_.push_back({t, closure.least_row});
  if (crossed || landed) highest_ = now.sine;
  earlier_ = before_;
  before_ = last_;
  last_ = now;
}

/// The last three samples; two after the start.
bool SingularWatch::falls_along_a_line() const {
  const double slope = slope_between(before_.t, before_.sine, last_.t, last_.sine);
  if (!(slope < 0)) return false;
  if (!(before_.t > earlier_.t)) return true;
  const double steeper = slope_between(earlier_.t, earlier_.sine, before_.t, before_.sine) / slope;
  return std::abs(steeper - 1) < kSameFall;
}

double SingularWatch::expected() const {
  if (last_.sine >= before_.sine || last_.sine > kClose) return std::numeric_limits<double>::infinity();
  return last_.t + last_.sine * (last_.t - before_.t) / (before_.sine - last_.sine);
}

}  // namespace wishbone
