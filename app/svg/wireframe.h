#pragma once

#include <array>
#include <vector>

#include "app/svg/view.h"
#include "identification/modal_data.h"

namespace wishbone {

/// A structure as it is drawn.
struct Wireframe {
  Matrix3X nodes;                         ///< 3 x n [m]
  std::vector<std::array<int, 2>> lines;  ///< pairs of columns, the farthest from the viewer first
  bool lines_are_guessed = false;         ///< the data have none: neighbours are joined
  View view;

  /// Diagonal of the box round the nodes [m]; 0 for a single point.
  double size() const;
};

/// The nodes and lines of the data; where there are no lines, neighbours are joined (app/svg/neighbour_lines.h)
/// unless the nodes are so many that they show the structure by themselves.
Wireframe wireframe(const ModalData& data);

/// Displacements of the nodes in a mode (3 x n), the largest of length 1; zero where nothing was measured and
/// in a mode that moves nothing.
Matrix3X unit_displacement(const ModalData& data, int mode);

/// The structure at rest, in light grey.
SvgElement draw_at_rest(const Wireframe& frame, const Placement& place);

/// The structure with displaced nodes: lines and nodes coloured by the length of `displacement` (3 x n, unit),
/// drawn `amplitude` [m] times as large.
SvgElement draw_displaced(const Wireframe& frame, const Matrix3X& displacement, double amplitude,
                          const Placement& place);

}  // namespace wishbone
