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
  std::vector<double> split;  ///< frequencies that the choice of modes separates (ChosenModes::split) [rad/s]
};

/// Chosen normal modes of a model with lumped masses and, at x, y and z of the nodes named, attachment and constraint
/// modes (attachment_modes.h, constraint_modes.h), combined to a mode set of undamped modes (combined_modes.h). The
/// normal modes are those of the free body, or of the body held at the constraint nodes (fixed_interface_modes.h):
/// the reduction of Craig and Bampton, brought to modes of the free body. Throws InputError as these do, or if the
/// model has no such node, no lumped masses, there is no mode at all, or interfaces are to be held and none is
/// named.
FlexibleModes flexible_modes(const AnalyticalModel& model, const ModeChoice& normal,
                             const std::vector<int>& attachment_nodes,
                             const std::vector<int>& constraint_nodes,
                             NormalModes of = NormalModes::of_free_body);

}  // namespace wishbone
