#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Frame M rigidly on frame F: no coordinate.
struct FixedJoint {
  static constexpr const char* kKind = "fixed";
  static constexpr int kNq = 0;
  static constexpr int kNv = 0;
  static constexpr bool kRotates = false, kTranslates = false, kHasDrift = false;

  template <class T>
  void calc_across(double /*t*/, const T* /*q*/, AcrossJoint<kNv, T>& /*out*/) const {}
  template <class T>
  void calc_q_rate(const T*, const T*, T*) const {}
  void retract(const double*, double*) const {}
  void calc_displacement(const double*, const double*, double*) const {}
  void set_neutral(double*) const {}
  FixedJoint reversed() const { return {}; }
};

}  // namespace wishbone
