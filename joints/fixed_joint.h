#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Frame M rigidly on frame F: no coordinate.
struct FixedJoint {
  static constexpr int kNq = 0;
  static constexpr int kNv = 0;

  void calc_across(double /*t*/, const double* /*q*/, AcrossJoint<kNv>& /*out*/) const {}
  void calc_q_rate(const double*, const double*, double*) const {}
  void retract(const double*, double*) const {}
  void set_neutral(double*) const {}
};

}  // namespace wishbone
