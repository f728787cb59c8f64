#pragma once

#include "identification/chosen_modes.h"
#include "identification/identify.h"
#include "identification/mode_choice.h"

namespace wishbone {

/// Chosen elastic normal modes of a free model with lumped masses (`node_mass` is there): mass-orthonormal, orthogonal
/// to rigid motion, ascending. There may be none below a limit.
///
/// Up to 600 freedoms, and where a quarter of all modes or more is wanted of up to kMostDenseFreedoms (model_modes.h),
/// they come from a dense eigenproblem (free_free_modes.h), otherwise from a Lanczos iteration on the sparse matrices
/// (lowest_modes.h); how many there are below a limit is counted first (modes_below.h).
///
/// Throws InputError if the model is not free or has loose parts, if a number is listed that it has not, or if too many
/// modes of a large model are wanted; NumericsError as the iteration does.
ChosenModes normal_modes(const AnalyticalModel& model, const ModeChoice& choice);

}  // namespace wishbone
