#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// Reactions of all joints after calc_forward_dynamics: BodyMotion::F_joint of tree joints, Workspace::lambda of closures.
///
/// Of an over-constrained mechanism the motion determines the reactions up to self-stresses, multipliers n with D^T n = 0
/// together with what they leave in the tree joints around their loops. Of all sets the one of least norm is taken,
///
///     min sum over the joints of the loops |f|^2 + |t|^2/l^2,
///
/// f the force and t the moment at the joint, l the root mean square distance of these joints from their mean (so that the
/// result does not depend on units). It does not depend on which joints of a loop are cut either.
void calc_reactions(const System& system, Workspace& ws);

/// A reaction is what a joint holds: forces that act along its coordinates (motions, loads, springs, friction, limits) are none
/// of it. It is given on the first-named body, about the joint's point on that body, whether the joint carries a body or closes
/// a loop. Of body i's inboard joint, (moment, force), world axes:
Vector6 tree_joint_reaction(const System& system, const Evaluation<double>& ev, int i);

/// The joint's point on its first-named body, world axes [m].
Vector3 tree_joint_point(const System& system, const Evaluation<double>& ev, int i);

/// What the motion of a prescribed joint puts on the first-named body, likewise; zero of other joints.
Vector6 tree_joint_drive(const System& system, const Evaluation<double>& ev, int i);

/// The force or moment of that along the coordinate, positive lets it grow [N, N m].
double tree_joint_driving_force(const System& system, const Evaluation<double>& ev, int i);

}  // namespace wishbone
