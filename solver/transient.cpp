#include "solver/transient.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/error.h"
#include "solver/deflection_watch.h"
#include "solver/events.h"
#include "solver/failure_cause.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/loads.h"
#include "solver/run_check.h"

namespace wishbone {
namespace {

/// A redundant row that is open by more follows from no others: the closures contradict each other [m, rad].
constexpr double kContradiction = 1e-6;

/// Sums by name.
void add(const Statistics& part, Statistics& total) {
  for (const auto& [name, value] : part) {
    const auto known =
        std::find_if(total.begin(), total.end(), [&](const auto& entry) { return entry.first == name; });
    if (known == total.end())
      total.emplace_back(name, value);
    else
      known->second += value;
  }
}

/// One run: the clock of outputs, the list of stops, and the integrator between them.
class Run {
 public:
  Run(const System& system, State state, const TransientOptions& options, Workspace& ws, const Output& output,
      const std::function<bool(double)>& keep_going)
      : system_(system),
        options_(options),
        ws_(ws),
        output_(output),
        keep_going_(keep_going),
        state_(std::move(state)),
        guard_(limits(system, options), keep_going),
        deflections_(system),
        counts_turns_(counts_turns(system)) {
    stops_ = system.stop_times();
    std::erase_if(stops_, [&](double t) { return t <= state_.t || t >= options.duration; });
    stops_.push_back(options.duration);
  }

  void start(TransientSummary& summary) {
    summary.integrator = resolve(options_.integrator, system_);
    summary.assembly = assemble(system_, state_, ws_, options_.given);
    summary.warnings = check_prescribed_motions(system_, options_.duration, summary.integrator);
    std::ranges::copy(summary.assembly.warnings, std::back_inserter(summary.warnings));
    update_positions<double>(system_, state_.t, state_.q, ws_);
    update_markers<double>(system_, ws_);
    initialize_segments(system_, ws_);
    std::ranges::move(check_tires(system_, state_, ws_), std::back_inserter(summary.warnings));
    method_ = summary.integrator;
    choice_ = std::make_unique<MethodChoice>(system_, options_.duration, method_);
    guard_.start(state_.t);
    integrator_ = make_integrator(system_, method_, ws_, guard_);
    integrator_->restart(state_, work_);
    check_.emplace(system_, summary.integrator);
    emit();
  }

  void advance(TransientSummary& summary) {
    for (const double stop : stops_) {
      double t = state_.t;
      while (t < stop) {
        const Integrator::Step step = integrator_->step(stop);
        t = step.t;
        summary.t_end = t;
        t_reached_ = t;
        ++steps_;
        watch_singular_positions(t);
        check_->note_step(state_, ws_);
        emit_until(t);
        check_limits(t);
        guard_.accept(t);
        if (keep_going_ && t < options_.duration && !keep_going_(t)) throw Interrupted{};
        if (!step.events.empty()) restart(t, summary, step.events);
        if (t < stop) accept(t, summary);
        if (t < stop && choice_->due(t, guard_)) compare_methods(t, stop, summary);
      }
      if (stop < options_.duration) restart(stop, summary);
      state_.t = stop;
    }
    summary.status = TransientSummary::Status::complete;
    summary.message = "complete";
  }

  NumericsError explained(const NumericsError& error) const {
    return wishbone::explained(error, system_, t_reached_, state_.x, ws_);
  }

  void report(TransientSummary& summary) const {
    summary.singular_passages = watch_.passages();
    // that a failed run stands at a singular position does not mean that it has passed
    if (summary.status == TransientSummary::Status::failed)
      std::erase_if(summary.singular_passages, [&](const SingularPassage& p) {
        return p.t > summary.t_end - 1e-6 * std::max(1.0, summary.t_end);
      });
    summary.statistics = past_statistics_;
    if (integrator_) add(integrator_->statistics(), summary.statistics);
    if (better_) summary.warnings.push_back(slow_method(*better_));
    if (check_) std::ranges::move(check_->warnings(), std::back_inserter(summary.warnings));
    deflections_.report(summary.warnings);
  }

 private:
  static ProgressGuard::Limits limits(const System& system, const TransientOptions& options) {
    const double least = std::min(ProgressGuard::kLeastProgress * options.duration, options.interval);
    return {double(system.nv + system.n_rows), options.integrator.max_steps > 0 ? 0 : least,
            options.duration};
  }

  double output_time(long k) const { return static_cast<double>(k) * options_.interval; }

  void emit() {
    output_(state_, work_);
    check_->observe(state_, work_, ws_);
    deflections_.observe(state_);
    ++next_output_;
  }

  void emit_until(double t) {
    // an output that falls on the end of the step up to rounding belongs to the step
    const double slack = 1e-12 * std::max(1.0, std::abs(t));
    while (output_time(next_output_) <= t + slack && output_time(next_output_) <= options_.duration + slack) {
      const double t_out = output_time(next_output_);
      interpolate(std::min(t_out, t));
      state_.t = t_out;
      emit();
    }
  }

  /// The state at a time within the last step, brought onto the closures: a polynomial between two closed poses is not
  /// closed itself.
  void interpolate(double t) {
    integrator_->interpolate(t, state_, work_);
    normalize_quaternions(system_, state_.q);
    if (ws_.closure.kept.empty()) return;
    if (!project(system_, kProjectionTolerance, state_, ws_, integrator_->implicit_step()))
      throw StepsFailed({fmt::format("t = {:.9g} s", t),
                         "the state could not be brought back onto the cut joints", "",
                         "tighten analysis.rtol, or look for a singular position at this time"});
  }

  void restart(double t, TransientSummary& summary, std::span<const int> events = {}) {
    interpolate(t);
    if (!events.empty()) {
      update_positions<double>(system_, state_.t, state_.q, ws_);
      update_markers<double>(system_, ws_);
      pass_edges(system_, events, ws_);
    }
    integrator_->restart(state_, work_);
    ++summary.restarts;
  }

  /// Before anything else is evaluated: the closures are still as they were at the end of the step.
  void watch_singular_positions(double t) {
    if (system_.n_rows == 0) return;
    watch_.observe(t, ws_.closure);
    integrator_->pass_over(watch_.expected());
  }

  /// Looks after what is remembered from step to step: turns of angles, the choice of closure rows and of variables.
  void accept(double t, TransientSummary& summary) {
    if (counts_turns_) remember_angles(system_, state_, ws_);
    if (system_.n_rows == 0) return;
    if (integrator_->outlived()) {
      restart(t, summary);
    } else {
      check_redundant_rows(t);
    }
  }

  /// The redundant row that is open most, or -1 when all are closed.
  int open_redundant_row() const {
    int open = -1;
    double gap = kContradiction;
    for (const int row : redundant_rows(system_, ws_.closure.kept)) {
      if (!(std::abs(ws_.Phi[row]) > gap)) continue;
      open = row;
      gap = std::abs(ws_.Phi[row]);
    }
    return open;
  }

  /// Where the rank has not grown, redundant rows stay closed with the others, unless a motion is prescribed that the mechanism
  /// cannot follow. The last evaluation may lie off the closures by the error of the step; the projected state does not.
  void check_redundant_rows(double t) {
    if (open_redundant_row() < 0) return;
    interpolate(t);
    const int row = open_redundant_row();
    if (row < 0) return;
    throw StepsFailed(
        {fmt::format("t = {:.9g} s, {}", t, system_.row_name(row)),
         "the joints contradict each other: no pose near this one closes them all",
         fmt::format("open by {:.3g} (m or rad)", std::abs(ws_.Phi[row])),
         "look for a prescribed motion that the mechanism cannot follow, or a joint out of line"});
  }

  /// Goes on with another method where that takes less work; one that was asked for is kept, and the warning tells.
  void compare_methods(double t, double stop, TransientSummary& summary) {
    const bool free = options_.integrator.method == Method::automatic;
    if (method_.form == Form::ggl || (!free && better_)) return;
    interpolate(t);
    const auto better = choice_->try_others(state_, work_, stop, ws_, keep_going_);
    if (!better || (!free && better->gain < MethodChoice::kStiff)) return;
    // an order within the method that was asked for is free too
    if (!free && better->to.method != method_.method) {
      better_ = better;
      return;
    }
    summary.method_changes.push_back(*better);
    method_ = better->to;
    add(integrator_->statistics(), past_statistics_);
    integrator_ = make_integrator(system_, method_, ws_, guard_);
    integrator_->restart(state_, work_);
    choice_->change(method_, t, guard_);
  }

  static Diagnostic slow_method(const BetterMethod& better) {
    return {fmt::format("analysis.integrator, t = {:.9g} s", better.t),
            fmt::format("{} took {:.3g} times the work of {} where both were tried", method_text(better.from),
                        better.gain, method_text(better.to)),
            "",
            fmt::format("give integrator {}, or auto, which changes the method by itself",
                        to_string(better.to.method))};
  }

  void check_limits(double t) const {
    const IntegratorOptions& options = options_.integrator;
    if (options.max_steps <= 0 || steps_ < options.max_steps) return;
    throw NumericsError({fmt::format("t = {:.9g} s", t), "the allowed number of steps is used up",
                         std::to_string(steps_), "raise analysis.max_steps or loosen the tolerances"});
  }

  const System& system_;
  const TransientOptions& options_;
  Workspace& ws_;
  const Output& output_;
  const std::function<bool(double)>& keep_going_;
  State state_;
  Work work_;
  std::vector<double> stops_;
  ProgressGuard guard_;
  IntegratorOptions method_;  // in use
  std::unique_ptr<MethodChoice> choice_;
  std::unique_ptr<Integrator> integrator_;
  Statistics past_statistics_;          // of the methods that were left
  std::optional<BetterMethod> better_;  // than the method that was asked for
  SingularWatch watch_;
  std::optional<RunCheck> check_;
  DeflectionWatch deflections_;
  bool counts_turns_;
  long next_output_ = 0;
  long steps_ = 0;
  double t_reached_ = 0;  // end of the last step [s]
};

}  // namespace

TransientSummary run_transient(const System& system, State state, const TransientOptions& options,
                               Workspace& ws, const Output& output,
                               const std::function<bool(double)>& keep_going) {
  TransientSummary summary;
  Run run(system, std::move(state), options, ws, output, keep_going);
  try {
    run.start(summary);
    run.advance(summary);
  } catch (const Interrupted&) {
    summary.status = TransientSummary::Status::interrupted;
    summary.message = fmt::format("interrupted at t = {:.9g} s", summary.t_end);
  } catch (const NumericsError& error) {
    summary.status = TransientSummary::Status::failed;
    summary.message = run.explained(error).what();
  }
  run.report(summary);
  return summary;
}

}  // namespace wishbone
