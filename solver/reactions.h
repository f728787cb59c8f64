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

/// Force and moment of body i's inboard joint on its first-named body, at the outboard joint point Mo, world axes.
Vector6 tree_joint_reaction(const System& system, const Evaluation<double>& ev, int i);

/// Position of that point, world axes [m].
Vector3 tree_joint_point(const Evaluation<double>& ev, int i);

}  // namespace wishbone
