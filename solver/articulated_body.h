#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Articulated-body recursions [Featherstone 2008, ch. 7] in world axes about body origins, in the factored form of
/// [Rodriguez, Jain & Kreutz-Delgado 1991]. With P the articulated inertia of a body, H its hinge matrix:
///
///   D = H^T P H = L L^T,   G = P H L^-T,   P+ = P - G G^T   (what the parent feels through the joint)
///
/// Columns of G and pivots of L come one speed after the other, so L itself is never formed: L_jj = 1/Workspace::inverse_root[j] and
/// L_ij = h_i^T g_j. Velocity products c act through P+: Z+ = Z + G e + P+ c.
///
/// A flexible body condenses its modal coordinates the same way before its joint is treated:
///
///   M_zz = L_z L_z^T,   Y = L_z^-1 M_zr,   P = M_rr - Y^T Y.
///
/// M_zz is the identity unless joints hang on the body's interfaces, so a free flexible body costs O(modes).

/// P+, G and pivots of all bodies, from the tips inward, of the mass matrix; or, of M + h C + h^2 K with C and K of the flexible
/// bodies, where `implicit_step` h [s] is not zero: then what moves the modes has to overcome their stiffness too. Needs
/// update_positions.
void factor_inertia(const System& system, Workspace& ws, double implicit_step = 0);

/// What enters an acceleration.
enum class Terms {
  all,          ///< applied loads, velocity products, elastic and gyroscopic terms: v' of the motion
  hinge_forces  ///< generalised forces alone: M^-1 Workspace::hinge_force
};

/// The inward half of v' = M^-1 tau. With the factor M^-1 = F^T F [Rodriguez, Jain & Kreutz-Delgado 1991] it leaves e = F tau
/// in Workspace::e: what is left of the loads minus biases in every hinge, L^-1 (tau - H^T Z), and in the modes.
/// Needs factor_inertia (and update_state for Terms::all).
void calc_bias(const System& system, Terms terms, Workspace& ws);

/// The outward half: v' = F^T e and the accelerations A of all bodies. Since a closure's U is F D^T, forces D^T lambda are
/// added by e += U lambda, without a second inward sweep.
void calc_accelerations(const System& system, Terms terms, Workspace& ws, VectorX& v_rate);

/// Passes the wrenches z (6 x n, on body i, about its origin) through the joint of body i toward its parent, and writes
/// those rows of the factor U = L^-1 H^T z that belong to the joint.
void pass_through_joint(const TreeBody& body, const Workspace& ws, Eigen::Ref<Matrix6X> z,
                        Eigen::Ref<MatrixX> U);

}  // namespace wishbone
