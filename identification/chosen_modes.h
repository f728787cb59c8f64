#pragma once

#include <functional>
#include <string_view>

#include "identification/methods/modes.h"
#include "identification/mode_choice.h"

namespace wishbone {

/// Modes that were chosen from a body's, ascending.
struct ChosenModes : Modes {
  /// Angular frequencies [rad/s] that several modes have of which some are chosen and some are not. Shapes of equal frequency
  /// may be combined at will, so which deflections the chosen ones have is a matter of rounding.
  std::vector<double> split;
};

/// How many of the `all` modes of a body must be computed, from the lowest, so that those chosen are among them, and the one
/// after them where they are chosen by number. `count_below` says how many lie below a limit [rad/s], or more.
/// @throws InputError if there are not so many; `which` names the modes in the message ("elastic modes")
Eigen::Index lowest_needed(const ModeChoice& choice, Eigen::Index all,
                           const std::function<Eigen::Index(double)>& count_below, std::string_view which);

/// The chosen ones of the lowest modes.
/// @throws InputError if one is listed that is not there
ChosenModes chosen_modes(const ModeChoice& choice, const Modes& lowest, std::string_view which);

}  // namespace wishbone
