#pragma once

#include <functional>
#include <vector>

#include "core/error.h"
#include "solver/assembly.h"
#include "solver/integrator.h"
#include "solver/method_choice.h"
#include "solver/singular_watch.h"

namespace wishbone {

struct TransientOptions {
  std::vector<GivenSpeed> given;  ///< that the run starts with
  IntegratorOptions integrator;
  double duration = 1;     ///< [s]
  double interval = 0.01;  ///< between outputs [s]
};

/// What a transient run came to. Starts pessimistic.
struct TransientSummary {
  enum class Status { failed, interrupted, complete };
  Status status = Status::failed;
  std::string message = "not started";
  double t_end = 0;              ///< time reached [s]
  IntegratorOptions integrator;  ///< as resolved
  AssemblyReport assembly;
  Statistics statistics;                     ///< of all methods together
  std::vector<BetterMethod> method_changes;  ///< of `auto`, and of the order of a given bdf
  long restarts = 0;  ///< of the integrator at events, kinks of prescribed motions and changes of variables
  std::vector<SingularPassage> singular_passages;
  Warnings warnings;  ///< what should be doubted of the results
};

/// Called at every output time with a consistent state.
using Output = std::function<void(const State&, const Work&)>;

/// Assembles the initial state and integrates the equations of motion, calling `output` at every multiple of the interval.
/// Stops and restarts the integrator at kinks of prescribed motions and at road edges. `keep_going` is asked, with the
/// time reached, after every step and now and then within one; false interrupts the run. Where the integrator is `auto`
/// the method changes when another takes less work, and where it is bdf its order may be limited (solver/method_choice.h); work
/// without progress ends the run (solver/progress_guard.h).
/// @throws InputError when the state cannot be assembled; numerical failure comes back in the summary, after all output
///   that was computed
TransientSummary run_transient(const System& system, State state, const TransientOptions& options,
                               Workspace& ws, const Output& output,
                               const std::function<bool(double)>& keep_going = {});

}  // namespace wishbone
