#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// Free rotation about a common point. q = quaternion (w, x, y, z) of R_FM, v = w_FM in M components [rad/s].
/// H = [R_FM; 0]: as seen from F, d/dt (R_FM w) = R_FM (w' + w x w) = R_FM w', so H' v = 0.
struct SphericalJoint {
  static constexpr const char* kKind = "spherical";
  static constexpr int kNq = 4;
  static constexpr int kNv = 3;
  static constexpr bool kRotates = true, kTranslates = false, kHasDrift = false;

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
    set(q, quaternion(q) * quaternion_from_rotation_vector(Eigen::Map<const Vector3>(d)));
  }
  /// The rotation vector, of an angle in 0 ... pi, that turns q0 into q.
  void calc_displacement(const double* q0, const double* q, double* d) const {
    const Quaternion turn = quaternion(q0).conjugate() * quaternion(q);
    Eigen::Map<Vector3>{d} = rotation_vector_from_quaternion(turn.normalized());
  }
  void set_neutral(double* q) const { set(q, Quaternion::Identity()); }

 private:
  static Quaternion quaternion(const double* q) { return {q[0], q[1], q[2], q[3]}; }
  static void set(double* q, const Quaternion& Q) {
    Eigen::Map<Eigen::Vector4d>{q} = Eigen::Vector4d(Q.w(), Q.x(), Q.y(), Q.z()).normalized();
  }
};

}  // namespace wishbone
