#pragma once

#include <vector>

#include "core/error.h"
#include "solver/energy.h"
#include "solver/integrator.h"
#include "solver/workspace.h"

namespace wishbone {

/// Looks for jumps of the prescribed motions from 0 to `duration`.
/// @return warnings, naming joint, time and jump, of those whose speed jumps: it takes an infinite force
/// @throws InputError likewise of a position that jumps, which no body can follow
Warnings check_prescribed_motions(const System& system, double duration, const IntegratorOptions& options);

/// Looks at the tires of the assembled initial state.
/// @return warnings, naming tire and value, of those in the air, across their way, or faster than tires are
Warnings check_tires(const System& system, const State& state, Workspace& ws);

/// What a run checks of itself at every output, so that a wrong number does not go by without notice:
///   books      stored energy + loss - input is constant [J];
///   closures   cut joints are closed, redundant rows too;
///   numbers    coordinates, speeds, states and books are finite.
/// What is off by more than the run's own tolerances explain becomes a warning, what is not a number an error.
class RunCheck {
 public:
  /// @param options resolved
  RunCheck(const System& system, const IntegratorOptions& options) : system_(system), options_(options) {}

  /// After a step: its last evaluation tells how large the kinetic energy grows between outputs.
  void note_step(const State& state, const Workspace& ws);

  /// At an output, after its other evaluations: changes kinematics and forces in the workspace.
  /// @throws NumericsError naming time and coordinate when a number is not finite
  void observe(const State& state, const Work& work, Workspace& ws);

  Warnings warnings() const;

 private:
  /// The energies that are exchanged; their sum with the signs of the books is constant.
  struct Books {
    double kinetic = 0, gravity = 0, elastic = 0, loss = 0, input = 0;
    double balance() const { return kinetic + gravity + elastic + loss - input; }
    double size() const;
  };

  void check_finite(const State& state, const Books& books) const;
  void note_books(double t, const Books& books);
  void note_closures(double t, const Workspace& ws);
  double energy_tolerance() const;

  const System& system_;
  IntegratorOptions options_;
  bool started_ = false;
  Books first_, last_;
  double t_last_ = 0;
  double exchanged_ = 0;        ///< sum of all changes of the energies between outputs [J]
  double largest_ = 0;          ///< of the energies [J]
  double largest_kinetic_ = 0;  ///< [J]
  double drift_ = 0;            ///< largest |balance - first balance| [J]
  double worst_change_ = 0, t_worst_change_ = 0, t_before_change_ = 0;  ///< of the balance between outputs
  double gap_ = 0, t_gap_ = 0;                                          ///< largest of a closure [m or rad]
  int gap_row_ = -1;
};

}  // namespace wishbone
