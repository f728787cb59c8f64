#pragma once

#include "solver/evaluation.h"

namespace wishbone {

/// Phi, the unit wrenches W (the columns of D^T) and Phi' = D v + Phi_t of all closure rows. Needs update_markers.
template <class T>
void update_closures(const System& system, double t, Evaluation<T>& ev);

/// Second rates of all rows for the accelerations A and z'' in the evaluation.
template <class T>
void update_closure_accelerations(const System& system, double t, Evaluation<T>& ev);

/// Wrench W_p lambda of a closure on participant p, about its marker's origin, world axes.
template <class T>
Vector6T<T> closure_wrench(const Closure& closure, int participant, const VectorXT<T>& lambda,
                           const Evaluation<T>& ev);

/// Power that driven closures put in, -lambda . Phi_t [W].
template <class T>
T calc_driven_power(const System& system, double t, const VectorXT<T>& lambda);

/// Counts the turns of the closures' gauges from the markers' states.
void remember_closure_angles(const System& system, Evaluation<double>& ev);

}  // namespace wishbone
