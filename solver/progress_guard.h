#pragma once

#include <functional>

#include "core/error.h"

namespace wishbone {

/// Thrown out of an evaluation when the user wants the run to end.
struct Interrupted {};

/// No step succeeds from here: what it would lead to cannot be found, or is too far from the closures. The fault lies with no
/// element, which would name itself.
class StepsFailed : public NumericsError {
 public:
  using NumericsError::NumericsError;
};

/// A run that will not come to its end: no smaller step helps.
class HopelessRun : public StepsFailed {
 public:
  using StepsFailed::StepsFailed;
};

/// Bounds the work of a run and keeps it open to interruption. It is asked before every evaluation that an integrator wants, so
/// that no loop of an integrator can go on unseen. All limits are counts of evaluations, never clocks: equal runs end equally.
///
/// Hopeless is a step that is not accepted within kStepEvaluations, and a run that in kPatience / size evaluations advances by
/// less than kLeastProgress of its duration and less than an interval of outputs; with an evaluation of about a microsecond
/// for each unknown it would take days. Hopeless too, and sooner seen, are kStepPatience steps that advance by less than
/// kLeastAdvance of the duration: the run would take more than 1e13 of them.
class ProgressGuard {
 public:
  static constexpr double kStepEvaluations = 10'000;
  static constexpr double kPatience = 2e7;  ///< evaluations times speeds and closure rows
  static constexpr double kLeastProgress = 1e-4;
  static constexpr long kStepPatience = 10'000;  ///< accepted steps
  static constexpr double kLeastAdvance = 1e-9;

  struct Limits {
    double size = 1;  ///< speeds and closure rows
    double least_progress =
        0;                ///< [s] in kPatience / size evaluations; 0: the run may be as slow as it likes
    double duration = 0;  ///< [s]
  };
  ProgressGuard(Limits limits, std::function<bool(double)> keep_going);

  /// From here on progress is measured.
  void start(double t);

  /// Before an evaluation, or what costs as much as so many.
  /// @throws Interrupted, HopelessRun
  void count(double evaluations = 1);

  /// A step was accepted that ends at t.
  /// @throws HopelessRun
  void accept(double t);

  /// Evaluations so far.
  double work() const { return work_; }

 private:
  /// Time and effort where progress was last seen.
  struct Mark {
    double t = 0, effort = 0;
  };
  /// When `patience` has been spent since the mark: looks whether time has advanced by `least` and moves the mark.
  void look(Mark& mark, double effort, double patience, double least, const char* unit) const;

  Limits limits_;
  std::function<bool(double)> keep_going_;
  double t_ = 0;          // of the last accepted step
  double work_ = 0;       // so far
  double step_work_ = 0;  // at the last accepted step
  double asked_work_ = 0;
  long steps_ = 0;  // accepted
  Mark work_mark_, step_mark_;
};

}  // namespace wishbone
