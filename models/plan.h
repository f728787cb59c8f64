#pragma once

#include <string>
#include <vector>

#include "models/compile.h"

namespace wishbone {

/// What a scene is compiled to, before anything runs.
struct Plan {
  int bodies = 0, flexible_bodies = 0;
  int coordinates = 0, speeds = 0;  ///< of joints, elastic ones not counted
  int elastic_coordinates = 0;
  int prescribed = 0;  ///< joints that follow a given motion
  int closures = 0, closure_rows = 0;
  std::vector<std::string> redundant_rows;
  int mobility = 0;  ///< speeds (elastic ones included) minus independent closure rows
  int force_elements = 0;
  std::string form, integrator;
  std::vector<std::string> tree;        ///< one line a body: joint, parent, freedoms
  std::vector<std::string> identified;  ///< one line a body whose modes were identified: from what
  std::vector<std::string> kept;        ///< what the scene makes necessary
  std::vector<std::string> left_out;    ///< what it does not need, and why
};

/// Assembles the initial state (so that redundant rows are known) and takes stock.
/// @throws InputError when the state cannot be assembled
Plan make_plan(const CompiledScene& compiled);

}  // namespace wishbone
