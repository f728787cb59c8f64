#pragma once

#include <array>
#include <vector>

#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// Rods and beams (descriptors 11, 21 to 24): their record in dataset 2412 has a line of orientation and
/// sections.
bool is_uff_beam(int descriptor);

/// Pairs of nodes that the edges of an element join, mid-side nodes included: beams and springs along their
/// nodes, shells (41 to 96) around them, tetrahedra, wedges and bricks (111 to 116, 118) in the order of the
/// standard, rigid elements (121, 122) from their first node. Nothing for other kinds. Nodes that are zero
/// are passed over.
std::vector<std::array<int, 2>> uff_element_edges(const UffElement& element);

}  // namespace wishbone
