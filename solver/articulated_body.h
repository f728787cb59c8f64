#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Articulated-body recursions [Featherstone 2008, ch. 7] in world axes about body origins, in the factored form of
/// [Rodriguez, Jain & Kreutz-Delgado 1991]. With P the articulated inertia of a body, H its hinge matrix:
///
///   D = H^T P H = L L^T,   G = P H L^-T,   P+ = P - G G^T   (what the parent feels through the joint)
///
/// A flexible body condenses its modal coordinates the same way before its joint is treated:
///
///   M_zz = L_z L_z^T,   Y = L_z^-1 M_zr,   P = M_rr - Y^T Y.
///
/// M_zz is the identity unless joints hang on the body's nodes, so a free flexible body costs O(modes).

/// P, L, G of all bodies, from the tips inward. Needs update_positions.
void factor_inertia(const System& system, Workspace& ws);

/// What enters solve_accelerations.
enum class Terms {
  all,         ///< applied loads, velocity products, elastic and gyroscopic terms: v' of the motion
  loads_only,  ///< applied loads alone: M^-1 of them
};

/// v' = M^-1 (loads - bias) and the accelerations A of all bodies, from the loads in BodyState::F_applied and
/// FlexibleState::load. Needs factor_inertia (and update_velocities for Terms::all). Leaves in BodyState::Z the bias
/// that, with P A + Z, gives the force through the inboard joint.
void solve_accelerations(const System& system, Terms terms, Workspace& ws, VectorX& v_rate);

/// Passes the wrenches z (6 x n, on body i, about its origin) through the joint of body i toward its parent, and writes
/// the rows of the factor U = L^-1 H^T z that belong to the joint.
void pass_through_joint(const TreeBody& body, const BodyState& s, Eigen::Ref<Matrix6X> z,
                        Eigen::Ref<MatrixX> U);

}  // namespace wishbone
