#pragma once

#include <Eigen/Geometry>

#include "joints/joint_motion.h"
#include "joints/motion.h"

namespace wishbone {

/// A revolute or prismatic joint whose coordinate is a given function of time: no unknown is left, the motion enters
/// as drift, and the force that drives it is an output [theory.md 2].
struct PrescribedJoint {
  static constexpr int kNq = 0;
  static constexpr int kNv = 0;
  enum class Kind { revolute, prismatic };

  Kind kind = Kind::revolute;
  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector
  Motion motion;

  void calc_across(double t, const double* /*q*/, AcrossJoint<kNv>& out) const {
    const MotionValue u = motion.at(t);
    if (kind == Kind::revolute) {
      out.X_FM.R = Eigen::AngleAxisd(u.position, axis_F).toRotationMatrix();
      out.V_drift.head<3>() = u.rate * axis_F;
      out.A_drift.head<3>() = u.acceleration * axis_F;
    } else {
      out.X_FM.p = u.position * axis_F;
      out.V_drift.tail<3>() = u.rate * axis_F;
      out.A_drift.tail<3>() = u.acceleration * axis_F;
    }
  }
  void calc_q_rate(const double*, const double*, double*) const {}
  void retract(const double*, double*) const {}
  void set_neutral(double*) const {}
};

}  // namespace wishbone
