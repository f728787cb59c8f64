#pragma once

#include <functional>
#include <string_view>

#include "identification/methods/modes.h"
#include "identification/mode_choice.h"

namespace wishbone {

/// How many of the `all` modes of a body must be computed, from the lowest, so that those chosen are among them.
/// `count_below` says how many lie below a limit [rad/s], or more.
/// @throws InputError if there are not so many; `which` names the modes in the message ("elastic modes")
Eigen::Index lowest_needed(const ModeChoice& choice, Eigen::Index all,
                           const std::function<Eigen::Index(double)>& count_below, std::string_view which);

/// The chosen ones of the lowest modes.
/// @throws InputError if one is listed that is not there
Modes chosen_modes(const ModeChoice& choice, const Modes& lowest, std::string_view which);

}  // namespace wishbone
