#pragma once

#include <Eigen/Geometry>

#include "joints/joint_motion.h"
#include "joints/motion.h"

namespace wishbone {

/// A revolute or prismatic joint whose coordinate is a given function of time: no unknown is left, the motion enters
/// as drift, and the force that drives it is an output [theory.md 2].
struct PrescribedJoint {
  static constexpr int kNq = 0;
  static constexpr bool kHasDrift = true;
  static constexpr int kNv = 0;
  enum class Kind { revolute, prismatic };

  Kind kind = Kind::revolute;
  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector
  Motion motion;

  template <class T>
  void calc_across(double t, const T* /*q*/, AcrossJoint<kNv, T>& out) const {
    const MotionValue u = motion.at(t);
    if (kind == Kind::revolute)
      out.X_FM.R = rotation_about(axis_F, T(u.position));
    else
      out.X_FM.p = (u.position * axis_F).cast<T>();
  }
  template <class T>
  void calc_drift(double t, const T*, const T*, Vector6T<T>& V, Vector6T<T>& A) const {
    const MotionValue u = motion.at(t);
    V.setZero();
    A.setZero();
    const int start = kind == Kind::revolute ? 0 : 3;
    V.template segment<3>(start) = (u.rate * axis_F).cast<T>();
    A.template segment<3>(start) = (u.acceleration * axis_F).cast<T>();
  }
  template <class T>
  void calc_q_rate(const T*, const T*, T*) const {}
  void retract(const double*, double*) const {}
  void calc_displacement(const double*, const double*, double*) const {}
  void set_neutral(double*) const {}
};

}  // namespace wishbone
