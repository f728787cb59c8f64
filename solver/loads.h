#pragma once

#include "solver/evaluation.h"
#include "solver/work_counters.h"

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
template <class T>
ForceInputT<T> force_input(double t, const VectorXT<T>& x, int x_start, int state_count, int index,
                           const Evaluation<T>& ev) {
  return {t,
          ev.markers,
          {x.data() + x_start, static_cast<std::size_t>(state_count)},
          ev.memory.segments[index],
          ev.memory.force_angles[index],
          ev.variables};
}

/// Evaluates all force elements at the markers' states, sums gravity and their wrenches into the bodies' F_applied and the
/// flexible bodies' modal loads; sets x_rate and element_powers. Needs update_markers.
template <class T>
void apply_forces(const System& system, double t, const VectorXT<T>& x, Evaluation<T>& ev);

/// Counts one evaluation of all force elements and what it takes of signals and drives.
void count_forces(const System& system, WorkCounters& work);

/// Sets all applied loads to zero.
template <class T>
void clear_loads(Evaluation<T>& ev);

/// Adds W lambda of every closure to the loads.
template <class T>
void add_closure_loads(const System& system, const VectorXT<T>& lambda, Evaluation<T>& ev);

/// Whether any gauge has turns to count.
bool counts_turns(const System& system);

/// Counts the turns of every gauge from the markers' states of the last evaluation: after an accepted step, from which no
/// angle has moved by half a turn.
void remember_angles(const System& system, const State& state, Evaluation<double>& ev);

}  // namespace wishbone
