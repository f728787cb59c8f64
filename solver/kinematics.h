#pragma once

#include "solver/evaluation.h"

namespace wishbone {

/// Poses of all bodies and deflections of the flexible ones, from the root outward:
///   X_WB = X_WP X_PF X_FM(q) X_MB;  of a joint on an interface X_PF = X_PI(z) X_IF follows the deflections.
template <class T>
void update_positions(const System& system, double t, const VectorXT<T>& q, Evaluation<T>& ev);

/// Velocities V_WB = shift(V_WP) + H v + V_drift and the velocity products c. Needs update_positions.
template <class T>
void update_velocities(const System& system, double t, const VectorXT<T>& q, const VectorXT<T>& v,
                       Evaluation<T>& ev);

/// Poses and velocities of all markers. Needs update_positions and update_velocities.
template <class T>
void update_markers(const System& system, Evaluation<T>& ev);

/// Accelerations of the markers of all closures from the bodies' A and the flexible bodies' z''.
template <class T>
void update_closure_marker_accelerations(const System& system, Evaluation<T>& ev);

/// q' = N(q) v, force-element states left out.
template <class T>
void calc_q_rate(const System& system, const VectorXT<T>& q, const VectorXT<T>& v, T* q_rate);

/// Moves q along the displacement d (size nv), to first order by N(q) d; quaternions keep unit length.
void retract(const System& system, const VectorX& d, Eigen::Ref<VectorX> q);

/// The displacement d (size nv) that retracts q0 to q.
void calc_displacement(const System& system, const VectorX& q0, const VectorX& q, Eigen::Ref<VectorX> d);

/// Scales every quaternion in q to unit length.
void normalize_quaternions(const System& system, Eigen::Ref<VectorX> q);

}  // namespace wishbone
