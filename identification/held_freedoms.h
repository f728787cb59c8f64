#pragma once

#include "identification/modal_data.h"

namespace wishbone {

/// The data with a row of zeros for every freedom that a joint along an axis of the body holds and that was not
/// measured, as nobody measures a point that stands still. Rows come out node by node in x, y, z.
ModalData with_held_freedoms(const ModalData& data);

}  // namespace wishbone
