#pragma once

#include <vector>

#include "solver/random/mechanism.h"

namespace wishbone::testing {

struct BodyMotions {
  std::vector<Pose> poses;          ///< X_WB
  std::vector<Vector6> velocities;  ///< V_WB
};

/// What Simbody makes of a mechanism. Spatial vectors have world axes.
struct SimbodyAnswer {
  BodyMotions start, end;
  std::vector<Vector6> accelerations;      ///< A_WB at the start
  std::vector<Vector6> joint_reactions;    ///< on the bodies carried, about the outboard joint points
  std::vector<Vector6> closure_reactions;  ///< on A, about the marker's origin
};

/// Whether the program that links Simbody was built.
bool simbody_is_installed();

/// Runs that program on the mechanism from the given motions of the bodies. It takes the mechanism as JSON: what mechanism.h
/// holds, with `poses` and `velocities` of the bodies, `duration` and `accuracy`; rotations are nine numbers, rows first.
/// @throws std::runtime_error with what the program said
SimbodyAnswer ask_simbody(const Mechanism& mechanism, const BodyMotions& start, double duration,
                          double accuracy);

}  // namespace wishbone::testing
