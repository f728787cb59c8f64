#pragma once

#include <array>
#include <vector>

#include "identification/elements/mesh.h"

namespace wishbone {

/// The edges of the elements, each once, those of quadratic ones in two halves, as pairs of node ids: the lines to draw a meshed structure by
/// (ModalData::lines). Ordered by the columns of their nodes, the lower column first.
std::vector<std::array<int, 2>> element_edges(const Mesh& mesh);

}  // namespace wishbone
