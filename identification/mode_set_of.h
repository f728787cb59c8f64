#pragma once

#include "bodies/mode_set.h"
#include "identification/modal_data.h"

namespace wishbone {

/// Free-free modes as a body that can be simulated: positions about the mass centre, unit modal masses.
/// @throws InputError unless the structure is free, has lumped masses at every node and all three directions of
///   each, and its modes are orthogonal to one another and to rigid motion (ModeSet::validate)
ModeSet mode_set_of(const ModalData& modes);

/// The way back: free-free modes as data that may be written to a file.
ModalData modal_data_of(const ModeSet& set, std::string title);

}  // namespace wishbone
