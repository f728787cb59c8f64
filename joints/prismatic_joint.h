#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Translation by q [m] along an axis fixed in F and M; v = q' [m/s].
struct PrismaticJoint {
  static constexpr int kNq = 1;
  static constexpr bool kHasDrift = false;
  static constexpr int kNv = 1;

  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.p = q[0] * axis_F;
    out.H.template tail<3>() = axis_F.cast<T>();
  }
  template <class T>
  void calc_q_rate(const T*, const T* v, T* q_rate) const { q_rate[0] = v[0]; }
  void retract(const double* d, double* q) const { q[0] += d[0]; }
  void calc_displacement(const double* q0, const double* q, double* d) const { d[0] = q[0] - q0[0]; }
  void set_neutral(double* q) const { q[0] = 0; }
};

}  // namespace wishbone
