#include "joints/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/jet2.h"
#include "core/require.h"

namespace wishbone {

namespace {

// s(u) = 6 u^5 - 15 u^4 + 10 u^3 on 0 ... 1
Jet2 smooth_step(const Jet2& u) {
  if (u.value <= 0) return 0.0;
  if (u.value >= 1) return 1.0;
  return u * u * u * (u * (6.0 * u - 15.0) + 10.0);
}

// tan(wheel) = l tan(delta)/(l -+ (w/2) tan(delta))
Jet2 wheel_angle(const Ackermann& a, const Jet2& delta) {
  const double half = a.side == Ackermann::Side::kLeft ? -0.5 * a.track : 0.5 * a.track;
  const Jet2 t = tan(delta);
  return atan(a.wheelbase * t / (a.wheelbase + half * t));
}

// no sum of parts of the steps can exceed this
double largest_command(double start, const std::vector<MotionStep>& steps) {
  double up = start, down = start;
  for (const MotionStep& s : steps) (s.change > 0 ? up : down) += s.change;
  return std::max(std::abs(up), std::abs(down));
}

}  // namespace

Motion::Motion(std::string_view element, double start, std::vector<MotionStep> steps,
               std::optional<Ackermann> ackermann)
    : start_(start), steps_(std::move(steps)), ackermann_(ackermann) {
  require(std::isfinite(start), element, "the start value must be finite", start, "give it in rad or m");
  for (const MotionStep& s : steps_) {
    require(s.duration > 0, element, "a step needs a positive duration", s.duration,
            "a jump has no acceleration: spread it over a short time");
    require(std::isfinite(s.time + s.duration + s.change), element, "a step must be finite", s.change,
            "give its time, duration and change");
  }
  if (!ackermann_) return;
  require(ackermann_->wheelbase > 0, element, "the wheelbase must be positive", ackermann_->wheelbase,
          "give it in m");
  require(ackermann_->track >= 0, element, "the track must not be negative", ackermann_->track,
          "give it in m");
  const double limit =
      std::min(std::atan2(2 * ackermann_->wheelbase, ackermann_->track), 0.5 * std::numbers::pi);
  const double command = largest_command(start_, steps_);
  require(command < limit, element,
          "the steering command must stay below the angle where the inner wheel stands across", command,
          "steer less, in radians");
}

MotionValue Motion::at(double t) const {
  const Jet2 time = Jet2::variable(t);
  Jet2 x = start_;
  for (const MotionStep& s : steps_) x = x + s.change * smooth_step((time - s.time) / s.duration);
  if (ackermann_) x = wheel_angle(*ackermann_, x);
  return {x.value, x.d1, x.d2};
}

std::vector<double> Motion::stop_times() const {
  std::vector<double> times;
  for (const MotionStep& s : steps_) {
    times.push_back(s.time);
    times.push_back(s.time + s.duration);
  }
  std::sort(times.begin(), times.end());
  // edges that differ by rounding alone are one: no integrator can step between them
  const auto same = [](double a, double b) { return b - a <= 1e-12 * std::max(1.0, std::abs(b)); };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

}  // namespace wishbone
