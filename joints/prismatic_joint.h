#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Translation by q [m] along an axis fixed in F and M; v = q' [m/s].
struct PrismaticJoint {
  static constexpr int kNq = 1;
  static constexpr int kNv = 1;

  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector

  void calc_across(double /*t*/, const double* q, AcrossJoint<kNv>& out) const {
    out.X_FM.p = q[0] * axis_F;
    out.H.tail<3>() = axis_F;
  }
  void calc_q_rate(const double*, const double* v, double* q_rate) const { q_rate[0] = v[0]; }
  void retract(const double* d, double* q) const { q[0] += d[0]; }
  void set_neutral(double* q) const { q[0] = 0; }
};

}  // namespace wishbone
