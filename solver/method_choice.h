#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/energy.h"
#include "solver/integrator.h"
#include "solver/progress_guard.h"
#include "solver/workspace.h"

namespace wishbone {

/// Another method that got on with less work where it was tried.
struct BetterMethod {
  double t = 0;  ///< [s]
  IntegratorOptions from, to;
  double gain = 1;  ///< evaluations per simulated second, of the old over the new
};

/// Finds out while a run goes on whether another method would take less work: stiffness is measured, not guessed. When a long
/// run is still ahead, the other methods are tried from the present state for a few steps, on the side; the run itself
/// does not notice. Work is counted in evaluations, so that equal runs choose equally. A trial may take kWindow evaluations or
/// kTrialShare of the work of the run, the larger: vibrations that the old method has left must have time to decay.
///
/// At the end of every window of kWindow evaluations in which the run advanced at a pace that leaves kWorthwhile to its end,
/// others are tried; in vain, then not again before the work of the run has grown to kAgain times, or the pace has fallen as much.
class MethodChoice {
 public:
  static constexpr double kWindow = 1e4;      ///< evaluations
  static constexpr double kWorthwhile = 1e5;  ///< evaluations
  static constexpr double kAgain = 4;
  static constexpr double kTrialShare = 0.02;
  static constexpr double kStiff = 3;  ///< gain for which an explicit method is left

  MethodChoice(const System& system, double duration, const IntegratorOptions& chosen);

  /// After an accepted step: whether the others should be tried now.
  bool due(double t, const ProgressGuard& guard);

  /// The best of the other methods, tried from a state that is consistent; none when it is best to go on as before. `ws`
  /// is a copy.
  /// @throws Interrupted
  std::optional<BetterMethod> try_others(const State& state, const Work& work, double t_stop, Workspace ws,
                                         const std::function<bool(double)>& keep_going) const;

  /// The run goes on with another method.
  void change(const IntegratorOptions& chosen, double t, const ProgressGuard& guard);

 private:
  void begin_window(double t, double work);
  std::vector<IntegratorOptions> others() const;

  const System& system_;
  double duration_;
  IntegratorOptions chosen_;
  double work_ = 0;                            // of the run so far
  double pace_ = 0;                            // evaluations per simulated second in the last window
  double window_t_ = 0, window_work_ = 0;      // where the window began
  double rejected_pace_ = 0, next_trial_ = 0;  // after a trial in vain
};

/// "erk", "bdf", "bdf of order 2"
std::string method_text(const IntegratorOptions& options);
/// "0.00135 s: from erk to bdf, 76.2 times less work"
std::string text(const BetterMethod& change);

}  // namespace wishbone
