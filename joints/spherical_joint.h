#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Free rotation about a common point. q = quaternion (w, x, y, z) of R_FM, v = w_FM in M components [rad/s].
/// H = [R_FM; 0]: as seen from F, d/dt (R_FM w) = R_FM (w' + w x w) = R_FM w', so H' v = 0.
struct SphericalJoint {
  static constexpr int kNq = 4;
  static constexpr bool kHasDrift = false;
  static constexpr int kNv = 3;

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.R = rotation_from_quaternion(q);
    out.H.template topRows<3>() = out.X_FM.R;
  }
  template <class T>
  void calc_q_rate(const T* q, const T* v, T* q_rate) const {
    Eigen::Map<Eigen::Matrix<T, 4, 1>>{q_rate} = quaternion_rate<T>(q, Eigen::Map<const Vector3T<T>>(v));
  }
  /// q o exp(d/2), which also restores unit length.
  void retract(const double* d, double* q) const {
    const Quaternion moved =
        Quaternion(q[0], q[1], q[2], q[3]) * quaternion_from_rotation_vector(Eigen::Map<const Vector3>(d));
    Eigen::Map<Eigen::Vector4d>{q} = Eigen::Vector4d(moved.w(), moved.x(), moved.y(), moved.z()).normalized();
  }
  void calc_displacement(const double* q0, const double* q, double* d) const {
    const Quaternion from(q0[0], q0[1], q0[2], q0[3]), to(q[0], q[1], q[2], q[3]);
    Eigen::Map<Vector3>{d} = rotation_vector_from_quaternion((from.conjugate() * to).normalized());
  }
  void set_neutral(double* q) const { Eigen::Map<Eigen::Vector4d>{q} = Eigen::Vector4d(1, 0, 0, 0); }
};

}  // namespace wishbone
