#pragma once

#include <string>
#include <vector>

#include "models/compile.h"
#include "models/joint_choices.h"

namespace wishbone {

/// A closure of the compiled scene: of a cut joint, a drive, a coupling ...
struct PlannedClosure {
  std::string name, kind;
  int rows = 0;
  ClosureGap given;   ///< how far it is open in the pose that the scene gives
  ClosureGap closed;  ///< and what is left when that is assembled
};

/// What a scene is compiled to, before anything runs.
struct Plan {
  int bodies = 0, flexible_bodies = 0;
  int coordinates = 0, speeds = 0;  ///< of joints, elastic ones not counted
  int elastic_coordinates = 0;
  int prescribed = 0;               ///< joints that follow a given motion
  std::vector<JointChoice> joints;  ///< the spanning tree
  std::vector<PlannedClosure> closures;
  int closure_rows = 0, rank = 0;           ///< rows in all, and how many are independent
  std::vector<std::string> redundant_rows;  ///< by joint and direction
  int mobility = 0;                         ///< speeds (elastic ones included) minus the rank
  std::vector<std::string> speeds_changed;  ///< that assembling changes: "B: speed: 0 -> -10"
  double displacement = 0;                  ///< largest change of a coordinate by assembling [m, rad]
  int force_elements = 0;
  std::string form, integrator;
  bool changes_method = false;          ///< where another takes less work
  std::vector<std::string> tree;        ///< one line a body: joint, parent, freedoms
  std::vector<BodyModes> modes;         ///< what the flexible bodies deform in
  std::vector<std::string> identified;  ///< one line a body whose modes were identified: from what
  std::vector<std::string> kept;        ///< what the scene makes necessary
  std::vector<std::string> left_out;    ///< what it does not need, and why
};

/// Assembles the initial state (so that gaps and redundant rows are known) and takes stock. `compiled` is made of `scene`.
/// @throws InputError when the state cannot be assembled
Plan make_plan(const Scene& scene, const CompiledScene& compiled);

}  // namespace wishbone
