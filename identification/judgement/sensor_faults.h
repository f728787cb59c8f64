#pragma once

#include <string>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// What is odd with the sensors of one node or with those of a measurement setup.
struct SensorFault {
  std::vector<int> nodes;  ///< several: what they have in common
  std::string what;        ///< "the sign of x is flipped", "the sensor is turned by about 30 deg about ..."
};

/// Holds every sensor against the modes of a suspension. In these a structure moves nearly as a rigid body,
///     psi_ij = A_i (t_j + theta_j x s_i),   A_i = 1 where the sensor is right,
/// at node i in mode j. t_j and theta_j are those that most nodes agree with (random sample consensus, M. A. Fischler,
/// R. C. Bolles, Comm. ACM 24, 1981, with a fixed seed), so that wrong sensors do not spoil what they are held against.
/// A_i is then looked for among flipped signs, exchanged axes, a scale, and rotations (Kabsch). A fault is named
/// only where it explains most of what the node deviates by, and that is well above what the others deviate by: true elastic
/// motion does not look so.
///
/// Nodes may be measured along some axes only. Nothing is found without suspension modes, as of a structure on joints,
/// or where fewer than four nodes agree.
std::vector<SensorFault> find_sensor_faults(const ModalData& measured);

/// The same in words: one sentence for each fault, with what it was held against.
std::vector<std::string> doubts_of_sensors(const ModalData& measured);

}  // namespace wishbone
