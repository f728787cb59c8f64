#pragma once

#include "joints/joint_motion.h"
#include "joints/motion.h"

namespace wishbone {

/// A revolute or prismatic joint whose coordinate u is a given function of time: no unknown is left, the motion enters
/// as drift, and the force that drives it is an output [theory.md 2].
struct PrescribedJoint {
  static constexpr const char* kKind = "prescribed";
  static constexpr int kNq = 0;
  static constexpr int kNv = 0;
  static constexpr bool kRotates = true, kTranslates = true, kHasDrift = true;
  enum class Kind { revolute, prismatic };

  Kind kind = Kind::revolute;
  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector
  Motion motion;

  template <class T>
  void calc_across(double t, const T* /*q*/, AcrossJoint<kNv, T>& out) const {
    const double u = motion.at(t).position;
    if (kind == Kind::revolute) {
      out.X_FM.R = rotation_about(axis_F, T(u));
    } else {
      out.X_FM.p = (u * axis_F).cast<T>();
    }
  }
  /// V_drift = u' and A_drift = u'' about or along the axis.
  template <class T>
  void calc_drift(double t, const T* /*q*/, const T* /*v*/, Vector6T<T>& V_drift,
                  Vector6T<T>& A_drift) const {
    const MotionValue u = motion.at(t);
    const int part = kind == Kind::revolute ? 0 : 3;
    V_drift.setZero();
    A_drift.setZero();
    V_drift.template segment<3>(part) = (u.rate * axis_F).cast<T>();
    A_drift.template segment<3>(part) = (u.acceleration * axis_F).cast<T>();
  }
  template <class T>
  void calc_q_rate(const T*, const T*, T*) const {}
  void retract(const double*, double*) const {}
  void calc_displacement(const double*, const double*, double*) const {}
  void set_neutral(double*) const {}
  PrescribedJoint reversed() const { return {kind, -axis_F, motion}; }
};

}  // namespace wishbone
