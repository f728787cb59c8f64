#pragma once

#include "solver/mechanisms.h"

namespace wishbone::testing {

/// A car of 15 bodies on four tires: each suspension link hangs on a chassis node by a spherical joint and is closed to a
/// second one, front knuckles turn by a prescribed steering motion, wheels roll on a level road with one depression. The
/// chassis is a block with `modes` elastic modes, or rigid with modes = 0. Running straight at 120 km/h.
Built car(int modes);

}  // namespace wishbone::testing
