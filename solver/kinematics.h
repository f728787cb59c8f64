#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Poses of all bodies and deflections of the flexible ones, from the root outward:
///   X_WB = X_WP X_PF X_FM(q) X_MB,  p_WF of a joint on a flexible node follows the node's deflection.
void update_positions(const System& system, double t, const VectorX& q, Workspace& ws);

/// Velocities V_WB = shift(V_WP) + H v + V_drift and the velocity products c. Needs update_positions.
void update_velocities(const System& system, double t, const VectorX& v, Workspace& ws);

/// Poses and velocities of all markers. Needs update_positions and update_velocities.
void update_markers(const System& system, Workspace& ws);

/// Accelerations of the markers of all closures from the bodies' A and the flexible bodies' z''.
void update_closure_marker_accelerations(const System& system, Workspace& ws);

/// q' = N(q) v, force-element states left out.
void calc_q_rate(const System& system, const VectorX& q, const VectorX& v, Eigen::Ref<VectorX> q_rate);

/// Moves q along the displacement d (size nv), to first order by N(q) d; quaternions keep unit length.
void retract(const System& system, const VectorX& d, Eigen::Ref<VectorX> q);

/// Scales every quaternion in q to unit length.
void normalize_quaternions(const System& system, Eigen::Ref<VectorX> q);

}  // namespace wishbone
