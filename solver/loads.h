#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Calls f(element, index) for every force element, type by type; the index counts over all of them.
template <class F>
void for_each_force(const System& system, F&& f) {
  int index = 0;
  std::apply(
      [&](const auto&... lists) {
        (([&](const auto& list) {
           for (const auto& element : list) f(element, index++);
         }(lists)),
         ...);
      },
      system.forces);
}

/// What force element `index`, with its states starting at x_start, is given.
ForceInput force_input(double t, const VectorX& x, int x_start, int state_count, int index,
                       const Workspace& ws);

/// Evaluates all force elements at the markers' states, sums gravity and their wrenches into the bodies' F_applied and the
/// flexible bodies' modal loads; sets x_rate and element_powers. Needs update_markers.
void apply_forces(const System& system, double t, const VectorX& x, Workspace& ws);

/// Sets all applied loads to zero.
void clear_loads(Workspace& ws);

/// Adds W_A lambda and W_B lambda of every closure to the loads.
void add_closure_loads(const System& system, const VectorX& lambda, Workspace& ws);

}  // namespace wishbone
