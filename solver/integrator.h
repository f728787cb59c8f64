#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/energy.h"
#include "solver/progress_guard.h"
#include "solver/workspace.h"

namespace wishbone {

/// How the equations of motion are put to an integrator [theory.md 2].
enum class Form {
  automatic,  ///< ode without closures, index1 with
  ode,        ///< v' from the tree alone; only without closures
  index1,  ///< v' and lambda from the closed system; positions and speeds projected onto the closures after each step
  partition,  ///< independent coordinates alone, the dependent ones solved from the closures in every evaluation
  ggl,  ///< Gear-Gupta-Leimkuhler: closures at both levels, the multipliers entering as derivatives of their integrals
};

enum class Method {
  automatic,
  /// CVODE Adams-Moulton, functional iteration; with index1 rates are taken at the projected state, since CVODE projects
  /// with bdf alone
  adams,
  bdf,  ///< CVODE BDF, Newton; with form ggl: IDA
  erk,  ///< ARKODE explicit Runge-Kutta
};

/// Options of a transient analysis.
struct IntegratorOptions {
  Form form = Form::automatic;
  Method method = Method::automatic;
  double rtol = 1e-6;   ///< relative tolerance
  double atol = 1e-8;   ///< absolute tolerance [m, rad, m/s, rad/s, m sqrt(kg) ...]
  double max_step = 0;  ///< [s]; 0: no limit
  long max_steps = 0;   ///< in total; 0: no limit
  int max_order = 0;    ///< of bdf; 0: 5
};

/// Name and value, in a fixed order.
using Statistics = std::vector<std::pair<std::string, double>>;

/// One integrator on one system. State between calls is its own; the Workspace is shared with the caller.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// (Re)starts from a consistent state; the history is dropped.
  virtual void restart(const State& state, const Work& work) = 0;

  struct Step {
    double t = 0;
    std::vector<int> events;  ///< indices of event functions that crossed zero at t
  };
  /// Takes one internal step, at most to t_stop.
  /// @throws NumericsError naming time and coordinate when the integrator gives up
  virtual Step step(double t_stop) = 0;

  /// A singular position is expected at t (infinite: none). Methods that can choose where their stages fall keep them clear
  /// of it; others go on as they are.
  virtual void pass_over(double /*t*/) {}

  /// State and work at any time within the last step.
  virtual void interpolate(double t, State& state, Work& work) = 0;

  /// Of implicit methods the step h [s] that Newton's iteration has last solved for, with the matrix 1 - h df/dy; 0 otherwise.
  virtual double implicit_step() const { return 0; }

  /// After an accepted step: whether the integration must be restarted, because the variables it was set up for no longer suit.
  virtual bool outlived() = 0;

  virtual Statistics statistics() const = 0;
};

/// The form and method that `options` mean for this system.
/// @throws InputError when they do not fit
IntegratorOptions resolve(const IntegratorOptions& options, const System& system);

/// @param options resolved
/// @param guard counts what the integrator evaluates
std::unique_ptr<Integrator> make_integrator(const System& system, const IntegratorOptions& options,
                                            Workspace& ws, ProgressGuard& guard);

const char* to_string(Form form);
const char* to_string(Method method);

}  // namespace wishbone
