#pragma once

#include "app/svg/wireframe.h"

namespace wishbone {

/// What a structure is held by, drawn on the structure at rest: a spring as a zigzag to a hatched ground, a
/// joint as a triangle on the ground, both along their direction and away from the middle of the structure
/// (downwards where they are upright); a mass of the support as a small square. Directions along the line of
/// sight become a ring.
SvgElement draw_support(const ModalData& data, const Wireframe& frame, const Placement& place);

}  // namespace wishbone
