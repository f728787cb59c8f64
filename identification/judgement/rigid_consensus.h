#pragma once

#include <optional>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// The rigid motion in the suspension modes of a measurement, as most of its nodes have it.
struct RigidConsensus {
  /// One node: what was measured and what the rigid motion would be, each mode scaled to a root mean square of one.
  struct Sensor {
    int node = 0;
    std::vector<int> axes;  ///< that were measured
    MatrixX measured;       ///< axes x modes
    MatrixX rigid;          ///< 3 x modes, all axes
    /// |measured - rigid| / |rigid| over the measured axes.
    double deviation = 0;
  };
  std::vector<Sensor> sensors;
  int modes = 0;
  double scatter = 0;  ///< median deviation of the nodes that agree
};

/// Nothing when no mode is nearly rigid, or when fewer than four nodes and a third of all agree on the motion.
std::optional<RigidConsensus> rigid_consensus(const ModalData& measured);

}  // namespace wishbone
