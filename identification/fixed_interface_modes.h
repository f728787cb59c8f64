#pragma once

#include <vector>

#include "identification/chosen_modes.h"
#include "identification/identify.h"
#include "identification/mode_choice.h"

namespace wishbone {

/// Chosen fixed-interface normal modes of a model [Craig, Bampton 1968]: its vibrations while the interface freedoms
/// stand still,
///     (K_ss - lambda M_ss) phi = 0,   zero at the interfaces   (s: all other freedoms),
/// of unit modal mass, ascending, numbered from 1. K couples them with no constraint mode (constraint_modes.h), for
/// these need forces at the interfaces only: T^T K Phi = 0. Together the two span all that the structure can do,
/// once all are there.
///
/// `freedoms` (rows of the model, each once) must hold the body.
/// @throws InputError if more are chosen than there are, or if too many of a large model are wanted (model_modes.h)
///
/// Source: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968) 1313-1319.
ChosenModes fixed_interface_modes(const AnalyticalModel& model, const ModeChoice& choice,
                                  const std::vector<int>& freedoms);

}  // namespace wishbone
