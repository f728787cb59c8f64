#pragma once

#include "joints/spherical_joint.h"

namespace wishbone {

/// Six freedoms. q = (quaternion w x y z of R_FM, p_FMo in F [m]); v = (w_FM in M [rad/s], v_FMo in F [m/s]).
/// The translation speeds have F components, so that the flight of a spinning body does not look like a vibration
/// to the integrator.
struct FreeJoint {
  static constexpr const char* kKind = "free";
  static constexpr int kNq = 7;
  static constexpr int kNv = 6;
  static constexpr bool kRotates = true, kTranslates = true, kHasDrift = false;

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.R = rotation_from_quaternion(q);
    out.X_FM.p = Eigen::Map<const Vector3T<T>>(q + 4);
    out.H.template topLeftCorner<3, 3>() = out.X_FM.R;
    out.H.template bottomRightCorner<3, 3>().setIdentity();
  }
  template <class T>
  void calc_q_rate(const T* q, const T* v, T* q_rate) const {
    SphericalJoint{}.calc_q_rate(q, v, q_rate);
    Eigen::Map<Vector3T<T>>{q_rate + 4} = Eigen::Map<const Vector3T<T>>(v + 3);
  }
  void retract(const double* d, double* q) const {
    SphericalJoint{}.retract(d, q);
    Eigen::Map<Vector3>{q + 4} += Eigen::Map<const Vector3>(d + 3);
  }
  void calc_displacement(const double* q0, const double* q, double* d) const {
    SphericalJoint{}.calc_displacement(q0, q, d);
    Eigen::Map<Vector3>{d + 3} = Eigen::Map<const Vector3>(q + 4) - Eigen::Map<const Vector3>(q0 + 4);
  }
  void set_neutral(double* q) const {
    SphericalJoint{}.set_neutral(q);
    Eigen::Map<Vector3>{q + 4}.setZero();
  }
};

}  // namespace wishbone
