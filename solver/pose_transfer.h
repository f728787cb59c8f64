#pragma once

#include <vector>

#include "solver/workspace.h"

namespace wishbone {

/// Where a body is and how it moves: X_WB, and V_WB = (w, v) about Bo, world axes.
struct RigidMotion {
  Pose X_WB;
  Vector6 V = Vector6::Zero();
};

/// Sets the coordinates and speeds of all joints so that the bodies, undeformed and at rest in themselves, have these motions
/// (in the order of System::bodies): Newton on X_FM(q) = X_WF^-1 X_WB X_MB^-1 from the coordinates at hand, which tell angles from
/// those a turn away, then H v = V_FM - V_drift. What a joint does not allow is left out.
void set_rigid_motions(const System& system, const std::vector<RigidMotion>& motions, State& state,
                       Workspace& ws);

}  // namespace wishbone
