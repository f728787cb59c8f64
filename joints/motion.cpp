#include "joints/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/distinct_times.h"
#include "core/error.h"
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

bool is_finite(const Jet2& x) {
  return std::isfinite(x.value) && std::isfinite(x.d1) && std::isfinite(x.d2);
}

}  // namespace

Motion::Motion(std::string element, double start, std::vector<MotionStep> steps,
               std::optional<Ackermann> ackermann)
    : element_(std::move(element)), start_(start), steps_(std::move(steps)), ackermann_(ackermann) {
  require(std::isfinite(start), element_, "the start value must be finite", start, "give it in rad or m");
  for (const MotionStep& s : steps_) {
    require(s.duration > 0, element_, "a step needs a positive duration", s.duration,
            "a jump has no acceleration: spread it over a short time");
    require(std::isfinite(s.time + s.duration + s.change), element_, "a step must be finite", s.change,
            "give its time, duration and change");
  }
  if (!ackermann_) return;
  check_ackermann();
  const double largest = largest_command(start_, steps_);
  require(largest < steering_limit(), element_,
          "the steering command must stay below the angle where the inner wheel stands across", largest,
          "steer less, in radians");
}

Motion::Motion(std::string element, Function law, std::optional<Ackermann> ackermann)
    : element_(std::move(element)), law_(std::move(law)), ackermann_(ackermann) {
  for (const int variable : law_->variables())
    require(variable == Function::kTime, element_, "a motion must be a function of the time alone", variable,
            "let a force depend on signals instead");
  if (const Table* table = law_->table_of_time())
    require(table->interpolation() == Table::Interpolation::spline, element_,
            "a linear table has no acceleration at its points", table->first(),
            "interpolate it by a spline, or write a motion of steps");
  if (ackermann_) check_ackermann();
}

void Motion::check_ackermann() const {
  require(ackermann_->wheelbase > 0, element_, "the wheelbase must be positive", ackermann_->wheelbase,
          "give it in m");
  require(ackermann_->track >= 0, element_, "the track must not be negative", ackermann_->track,
          "give it in m");
}

double Motion::steering_limit() const {
  return std::min(std::atan2(2 * ackermann_->wheelbase, ackermann_->track), 0.5 * std::numbers::pi);
}

Jet2 Motion::command(double t) const {
  const Jet2 time = Jet2::variable(t);
  if (!law_) {
    Jet2 x = start_;
    for (const MotionStep& s : steps_) x = x + s.change * smooth_step((time - s.time) / s.duration);
    return x;
  }
  const Table* table = law_->table_of_time();
  if (!table) return (*law_)(std::span(&time, 1));
  const double inside = std::clamp(t, table->first(), table->last());
  if (std::abs(t - inside) > 1e-9 * (table->last() - table->first()))
    fail("the table of the motion does not reach this time", t, inside,
         "give points for the whole run: at an end the motion need not rest");
  return (*table)(Jet2::variable(inside));
}

MotionValue Motion::at(double t) const {
  Jet2 x = command(t);
  if (ackermann_) {
    if (law_ && !(std::abs(x.value) < steering_limit()))
      fail("the steering command reaches the angle where the inner wheel stands across", t, x.value,
           "steer less, in radians");
    x = wheel_angle(*ackermann_, x);
  }
  if (!is_finite(x))
    fail("the motion has no value, rate or acceleration", t, x.value,
         "look for a root of zero, a division by zero, an overflow or a jump in its expression");
  return {x.value, x.d1, x.d2};
}

void Motion::fail(const std::string& what, double t, double value, const std::string& remedy) const {
  throw NumericsError(
      {fmt::format("{} at t = {:g} s", element_, t), what, fmt::format("{:g}", value), remedy});
}

std::vector<double> Motion::switch_times() const {
  return may_jump() ? law_->expression()->switches(Function::kTime) : std::vector<double>{};
}

std::vector<double> Motion::stop_times() const {
  std::vector<double> times;
  if (law_ && !law_->table_of_time()) times = law_->stop_times();
  for (const MotionStep& s : steps_) {
    times.push_back(s.time);
    times.push_back(s.time + s.duration);
  }
  return distinct_times(std::move(times));
}

}  // namespace wishbone
