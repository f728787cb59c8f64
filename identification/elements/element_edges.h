#pragma once

#include <array>
#include <vector>

#include "identification/elements/hexahedral_mesh.h"

namespace wishbone {

/// The edges of the hexahedra, each once, as pairs of node ids: the lines to draw a meshed structure by
/// (ModalData::lines). Ordered by the columns of their nodes, the lower column first.
std::vector<std::array<int, 2>> element_edges(const HexahedralMesh& mesh);

}  // namespace wishbone
