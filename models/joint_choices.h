#pragma once

#include <string>
#include <vector>

#include "models/scene.h"

namespace wishbone {

/// What the spanning tree of a scene does with one of its joints, and why.
struct JointChoice {
  std::string joint, kind;
  std::string first, second;  ///< bodies
  bool cut = false;           ///< closes a loop; otherwise it carries a body
  bool pinned = false;        ///< by the scene's `cut`
  int rows = 0;               ///< closure rows that it costs where it closes a loop
  /// Of a cut joint: the tree joints between its bodies, and the rows that it saves against cutting the costliest of them;
  /// negative where a pin costs rows, against the cheapest of them.
  std::vector<std::string> loop;
  int saved = 0;
  std::string reason;  ///< for people
};

/// Of all joints, in the order of the scene.
std::vector<JointChoice> joint_choices(const Scene& scene);

}  // namespace wishbone
