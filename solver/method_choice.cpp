#include "solver/method_choice.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace wishbone {
namespace {

constexpr std::size_t kTrialSteps = 200;  // the second half of them is measured

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Evaluations in a step of erk. Where accuracy alone limits the steps, those of bdf are the shorter ones, whatever they cost:
/// explicit steps are left for longer ones only.
constexpr double kExplicitStep = 8;

/// How a method gets on.
struct Pace {
  double work = kNever;  ///< evaluations per simulated second; infinite when it fails
  double step = 0;       ///< [s]
};

/// Of a method that is started at `state`.
Pace pace_of(const System& system, const IntegratorOptions& options, const State& state, const Work& work,
             double t_stop, double most_work, Workspace ws, const std::function<bool(double)>& keep_going) {
  ProgressGuard guard({}, [&](double) { return !keep_going || keep_going(state.t); });
  guard.start(state.t);
  struct Mark {
    double t, work;
  };
  std::vector<Mark> marks{{state.t, 0}};
  try {
    const auto integrator = make_integrator(system, options, ws, guard);
    integrator->restart(state, work);
    const auto goes_on = [&] {
      const bool few = marks.size() <= kTrialSteps && guard.work() < MethodChoice::kWindow;
      return marks.back().t < t_stop && (few || guard.work() < most_work);
    };
    while (goes_on()) {
      const Integrator::Step step = integrator->step(t_stop);
      guard.accept(step.t);
      marks.push_back({step.t, guard.work()});
      if (!step.events.empty()) break;
    }
  } catch (const NumericsError&) {
    return {};
  }
  const std::size_t last = marks.size() - 1, half = last / 2;
  const double time = marks[last].t - marks[half].t;
  if (!(time > 0)) return {};
  return {(marks[last].work - marks[half].work) / time, time / static_cast<double>(last - half)};
}

}  // namespace

std::string method_text(const IntegratorOptions& options) {
  if (options.max_order == 0) return to_string(options.method);
  return fmt::format("{} of order {}", to_string(options.method), options.max_order);
}

std::string text(const BetterMethod& change) {
  return fmt::format("{:.9g} s: from {} to {}, {:.3g} times less work", change.t, method_text(change.from),
                     method_text(change.to), change.gain);
}

MethodChoice::MethodChoice(const System& system, double duration, const IntegratorOptions& chosen)
    : system_(system), duration_(duration), chosen_(chosen) {}

void MethodChoice::begin_window(double t, double work) {
  window_t_ = t;
  window_work_ = work;
}

bool MethodChoice::due(double t, const ProgressGuard& guard) {
  const double work = work_ = guard.work();
  if (work - window_work_ < kWindow) return false;
  pace_ = (work - window_work_) / (t - window_t_);
  begin_window(t, work);
  if (pace_ * (duration_ - t) < kWorthwhile) return false;
  if (work < next_trial_ && pace_ < kAgain * rejected_pace_) return false;
  rejected_pace_ = pace_;
  next_trial_ = kAgain * work;
  return true;
}

/// In falling order of accuracy. BDF above order 2 is unstable for vibrations that are fast against the step and hardly damped.
std::vector<IntegratorOptions> MethodChoice::others() const {
  std::vector<IntegratorOptions> others;
  const auto add = [&](Method method, int max_order) {
    IntegratorOptions other = chosen_;
    other.method = method;
    other.max_order = max_order;
    if (other.method != chosen_.method || other.max_order != chosen_.max_order) others.push_back(other);
  };
  add(Method::erk, 0);
  add(Method::bdf, 0);
  add(Method::bdf, 2);
  return others;
}

std::optional<BetterMethod> MethodChoice::try_others(const State& state, const Work& work, double t_stop,
                                                     Workspace ws,
                                                     const std::function<bool(double)>& keep_going) const {
  std::optional<BetterMethod> best;
  for (const IntegratorOptions& other : others()) {
    const Pace pace = pace_of(system_, other, state, work, t_stop, kTrialShare * work_, ws, keep_going);
    if (chosen_.method == Method::erk && pace.step * pace_ < kStiff * kExplicitStep) continue;
    const double gain = pace_ / pace.work;
    const double wanted = (other.method == Method::erk ? 1 : kStiff) * (best ? best->gain : 1);
    if (gain > wanted) best = {state.t, chosen_, other, gain};
  }
  return best;
}

void MethodChoice::change(const IntegratorOptions& chosen, double t, const ProgressGuard& guard) {
  chosen_ = chosen;
  begin_window(t, guard.work());
  rejected_pace_ = next_trial_ = 0;
}

}  // namespace wishbone
