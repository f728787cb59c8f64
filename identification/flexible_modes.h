#pragma once

#include <string>
#include <vector>

#include "bodies/mode_set.h"
#include "identification/identify.h"
#include "identification/methods/combined_modes.h"
#include "identification/mode_choice.h"

namespace wishbone {

/// A free body reduced to modes, and where these come from.
struct FlexibleModes {
  ModeSet set;
  std::vector<ModeKind> kinds;  ///< of each mode of the set
  Eigen::Index left_out = 0;    ///< static shapes that added nothing
};

/// Chosen normal modes of a free model with lumped masses and, at x, y and z of the nodes named, attachment and
/// constraint modes (attachment_modes.h, constraint_modes.h), combined to a mode set of undamped modes
/// (combined_modes.h).
/// Throws InputError as these do, or if the model has no such node, no lumped masses, or there is no mode at all.
FlexibleModes flexible_modes(const AnalyticalModel& model, const ModeChoice& normal,
                             const std::vector<int>& attachment_nodes,
                             const std::vector<int>& constraint_nodes);

}  // namespace wishbone
