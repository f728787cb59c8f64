#include "solver/transient.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "solver/events.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

constexpr long kPatience = 10'000;  // steps between two looks at the progress
/// A redundant row that is open by more follows from no others: the closures contradict each other [m, rad].
constexpr double kContradiction = 1e-6;

/// One run: the clock of outputs, the list of stops, and the integrator between them.
class Run {
 public:
  Run(const System& system, State state, const TransientOptions& options, Workspace& ws, const Output& output)
      : system_(system),
        options_(options),
        ws_(ws),
        output_(output),
        state_(std::move(state)),
        counts_turns_(counts_turns(system)) {
    stops_ = system.stop_times();
    std::erase_if(stops_, [&](double t) { return t <= state_.t || t >= options.duration; });
    stops_.push_back(options.duration);
  }

  void start(TransientSummary& summary) {
    summary.integrator = resolve(options_.integrator, system_);
    summary.assembly = assemble(system_, state_, ws_, options_.given);
    summary.warnings = summary.assembly.warnings;
    update_positions<double>(system_, state_.t, state_.q, ws_);
    update_markers<double>(system_, ws_);
    initialize_segments(system_, ws_);
    integrator_ = make_integrator(system_, summary.integrator, ws_);
    integrator_->restart(state_, work_);
    emit();
  }

  void advance(const std::function<bool(double)>& keep_going, TransientSummary& summary) {
    for (const double stop : stops_) {
      double t = state_.t;
      while (t < stop) {
        const Integrator::Step step = integrator_->step(stop);
        t = step.t;
        summary.t_end = t;
        t_reached_ = t;
        ++steps_;
        watch_singular_positions(t);
        emit_until(t);
        check_limits(summary.integrator, t);
        check_progress(t);
        if (keep_going && t < options_.duration && !keep_going(t)) return interrupt(summary, t);
        if (!step.events.empty()) restart(t, summary, step.events);
        if (t < stop) accept(t, summary);
      }
      if (stop < options_.duration) restart(stop, summary);
      state_.t = stop;
    }
    summary.status = TransientSummary::Status::complete;
    summary.message = "complete";
  }

  /// A failure next to a singular position into which a motion drives the mechanism is that of the motion: beyond it no pose
  /// follows.
  [[nodiscard]] NumericsError explained(const NumericsError& error) const {
    if (!near_singular(ws_) || ws_.closure.least_row < 0) return error;
    const std::vector<std::string> motions = motions_against(ws_.closure.least_row);
    if (motions.empty()) return error;
    return NumericsError({fmt::format("t = {:.9g} s, {}", t_reached_, fmt::join(motions, ", ")),
                          "the mechanism cannot follow the prescribed motion",
                          fmt::format("at the end of its reach, {} closes no further",
                                      system_.row_name(ws_.closure.least_row)),
                          "shorten the motion, or drive another joint where this one turns back"});
  }

  void report(TransientSummary& summary) const {
    summary.singular_passages = watch_.passages();
    // that a failed run stands at a singular position does not mean that it has passed
    if (summary.status == TransientSummary::Status::failed)
      std::erase_if(summary.singular_passages, [&](const SingularPassage& p) {
        return p.t > summary.t_end - 1e-6 * std::max(1.0, summary.t_end);
      });
    summary.statistics = integrator_ ? integrator_->statistics() : Statistics{};
  }

 private:
  /// Joints and closures that move as prescribed at the end of the last step, in the loops of a closure row.
  std::vector<std::string> motions_against(int row) const {
    const auto closure = std::ranges::find_if(
        system_.closures, [&](const Closure& c) { return row >= c.row_start && row < c.row_start + c.rows; });
    const auto moves = [&](const Motion& motion) { return motion.at(t_reached_).rate != 0; };
    std::vector<std::string> names;
    for (const int i : closure->path)
      if (const auto* joint = std::get_if<PrescribedJoint>(&system_.bodies[i].joint);
          joint != nullptr && moves(joint->motion))
        names.push_back("joint '" + system_.bodies[i].joint_name + "'");
    for (const Closure& other : system_.closures) {
      const Motion* motion = drive(other.joint);
      if (motion == nullptr || !moves(*motion)) continue;
      if (std::ranges::find_first_of(other.path, closure->path) != other.path.end())
        names.push_back("'" + other.name + "'");
    }
    return names;
  }

  double output_time(long k) const { return static_cast<double>(k) * options_.interval; }

  void emit() {
    output_(state_, work_);
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
      throw NumericsError({fmt::format("t = {:.9g} s", t),
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
    throw NumericsError(
        {fmt::format("t = {:.9g} s, {}", t, system_.row_name(row)),
         "the joints contradict each other: no pose near this one closes them all",
         fmt::format("open by {:.3g} (m or rad)", std::abs(ws_.Phi[row])),
         "look for a prescribed motion that the mechanism cannot follow, or a joint out of line"});
  }

  void check_limits(const IntegratorOptions& options, double t) const {
    if (options.max_steps <= 0 || steps_ < options.max_steps) return;
    throw NumericsError({fmt::format("t = {:.9g} s", t), "the allowed number of steps is used up",
                         std::to_string(steps_), "raise analysis.max_steps or loosen the tolerances"});
  }

  /// Steps that shrink for ever reach no end: a rate at which the run would take more than 1e13 steps is a failure.
  void check_progress(double t) {
    if (steps_ % kPatience != 0) return;
    if (t - t_patience_ < 1e-9 * options_.duration)
      throw NumericsError({fmt::format("t = {:.9g} s", t), "the steps have become too small to go on",
                           fmt::format("{:g} s for the last {} steps", t - t_patience_, kPatience),
                           "look for a singular position, a discontinuity or a shock at this time"});
    t_patience_ = t;
  }

  void interrupt(TransientSummary& summary, double t) {
    summary.status = TransientSummary::Status::interrupted;
    summary.message = fmt::format("interrupted at t = {:.9g} s", t);
  }

  const System& system_;
  const TransientOptions& options_;
  Workspace& ws_;
  const Output& output_;
  State state_;
  Work work_;
  std::vector<double> stops_;
  std::unique_ptr<Integrator> integrator_;
  SingularWatch watch_;
  bool counts_turns_;
  long next_output_ = 0;
  long steps_ = 0;
  double t_reached_ = 0;  // end of the last step [s]
  double t_patience_ = 0;
};

}  // namespace

TransientSummary run_transient(const System& system, State state, const TransientOptions& options,
                               Workspace& ws, const Output& output,
                               const std::function<bool(double)>& keep_going) {
  TransientSummary summary;
  Run run(system, std::move(state), options, ws, output);
  try {
    run.start(summary);
    run.advance(keep_going, summary);
  } catch (const NumericsError& error) {
    summary.status = TransientSummary::Status::failed;
    summary.message = run.explained(error).what();
  }
  run.report(summary);
  return summary;
}

}  // namespace wishbone
