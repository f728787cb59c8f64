#pragma once

#include <string>
#include <vector>

#include "identification/formats/uff/uff_file.h"
#include "identification/modal_data.h"

namespace wishbone {

/// Axes that the components of nodal shapes refer to.
enum class UffShapeAxes {
  /// Dataset 55: the displacement coordinate system of each node, as test programs write measured directions;
  /// dataset 2414: global, as its specification says and finite-element programs write it.
  kByDataset,
  kDisplacementSystems,
  kGlobal,
};

/// Modes of a Universal File that belong to the same freedoms, in global axes.
struct UffModes {
  std::vector<Freedom> freedoms;  ///< r, node by node in the order of the file's nodes
  VectorX omega;                  ///< m, > 0, ascending [rad/s]
  VectorX damping_ratio;          ///< m, >= 0
  VectorX modal_mass;             ///< m, in the file's unit of mass; NaN where nothing is known
  MatrixX shapes;                 ///< r x m, real, the numbers of the file
  std::vector<std::string> provenance;
};

/// Collects the modes of a file. `where` is the place that errors name. Throws InputError, saying what the
/// file does hold, when it has no modes, or modes of nodes that have no position.
UffModes collect_uff_modes(const UffFile& file, UffShapeAxes axes, const std::string& where);

/// "10 nodes, 8 elements, 1 nodal result": for messages.
std::string describe(const UffFile& file);

}  // namespace wishbone
