#pragma once

#include <array>
#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// Lines that make a cloud of points readable, as pairs of columns (lower first): two points are joined unless
/// some third one is nearer to both of them than they are to each other (relative neighbourhood graph). It has
/// no parameter, connects all points, and gives back the lines of a rectangular grid. Distances that agree to
/// a millionth count as equal; points at the same place are not joined.
/// Source: G. T. Toussaint, The relative neighbourhood graph of a finite planar set, Pattern Recognition 12,
/// 1980, pp. 261-268.
std::vector<std::array<int, 2>> neighbour_lines(const Matrix3X& points);

}  // namespace wishbone
