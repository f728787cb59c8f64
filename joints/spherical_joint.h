#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Free rotation about a common point. q = quaternion (w, x, y, z) of R_FM, v = w_FM in M components [rad/s].
/// H = [R_FM; 0]: as seen from F, d/dt (R_FM w) = R_FM (w' + w x w) = R_FM w', so H' v = 0.
struct SphericalJoint {
  static constexpr int kNq = 4;
  static constexpr int kNv = 3;

  void calc_across(double /*t*/, const double* q, AcrossJoint<kNv>& out) const {
    out.X_FM.R = rotation_from_quaternion(Eigen::Map<const Eigen::Vector4d>(q));
    out.H.topRows<3>() = out.X_FM.R;
  }
  void calc_q_rate(const double* q, const double* v, double* q_rate) const {
    Eigen::Map<Eigen::Vector4d>{q_rate} =
        quaternion_rate(Eigen::Map<const Eigen::Vector4d>(q), Eigen::Map<const Vector3>(v));
  }
  /// q o exp(d/2), which also restores unit length.
  void retract(const double* d, double* q) const {
    const Quaternion moved =
        Quaternion(q[0], q[1], q[2], q[3]) * quaternion_from_rotation_vector(Eigen::Map<const Vector3>(d));
    Eigen::Map<Eigen::Vector4d>{q} = Eigen::Vector4d(moved.w(), moved.x(), moved.y(), moved.z()).normalized();
  }
  void set_neutral(double* q) const { Eigen::Map<Eigen::Vector4d>{q} = Eigen::Vector4d(1, 0, 0, 0); }
};

}  // namespace wishbone
