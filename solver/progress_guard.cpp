#include "solver/progress_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wishbone {
namespace {

constexpr double kBetweenQuestions = 16;  // evaluations between two looks at the user's wish

}  // namespace

ProgressGuard::ProgressGuard(Limits limits, std::function<bool(double)> keep_going)
    : limits_(limits), keep_going_(std::move(keep_going)) {
  limits_.size = std::max(1.0, limits_.size);
}

void ProgressGuard::start(double t) {
  t_ = t;
  step_work_ = work_;
  work_mark_ = {t, work_};
  step_mark_ = {t, static_cast<double>(steps_)};
}

void ProgressGuard::count(double evaluations) {
  work_ += evaluations;
  if (keep_going_ && work_ - asked_work_ >= kBetweenQuestions) {
    asked_work_ = work_;
    if (!keep_going_(t_)) throw Interrupted{};
  }
  const double futile = work_ - step_work_;
  if (futile > std::max(kStepEvaluations, 2 * evaluations))
    throw HopelessRun({fmt::format("t = {:.9g} s", t_), "no step could be made from here",
                       fmt::format("{:g} evaluations", futile),
                       "loosen analysis.rtol and analysis.atol, or take another form or integrator"});
}

void ProgressGuard::accept(double t) {
  t_ = t;
  step_work_ = work_;
  ++steps_;
  if (!(limits_.least_progress > 0)) return;
  look(step_mark_, static_cast<double>(steps_), kStepPatience, kLeastAdvance * limits_.duration, "steps");
  look(work_mark_, work_, kPatience / limits_.size, limits_.least_progress, "evaluations");
}

void ProgressGuard::look(Mark& mark, double effort, double patience, double least, const char* unit) const {
  const double spent = effort - mark.effort;
  if (spent < patience) return;
  if (t_ - mark.t < least)
    throw HopelessRun(
        {fmt::format("t = {:.9g} s", t_), "the steps have become too small to go on",
         fmt::format("{:g} s in the last {:g} {}", t_ - mark.t, spent, unit),
         "look for a singular position, a discontinuity, a shock or an extreme stiffness at this time, "
         "or loosen the tolerances; with analysis.max_steps given the run goes on up to that number"});
  mark = {t_, effort};
}

}  // namespace wishbone
