#pragma once

#include "joints/joint_motion.h"

namespace wishbone {

/// A joint traversed from its second-named body to its first-named one, with the same coordinates and speeds. With
/// X = (R, p), H and the motion (w, v), (alpha, a) those of the wrapped joint as its own F sees its M, that M sees F with
///     X'     = X^-1,
///     w'     = -R^T w,       v'  = -R^T (v - w x p),
///     alpha' = -R^T alpha,   a'  = -R^T (a - alpha x p - 2 w x v + w x (w x p)).
template <class Joint>
struct Reversed {
  static constexpr const char* kKind = Joint::kKind;
  static constexpr int kNq = Joint::kNq;
  static constexpr int kNv = Joint::kNv;
  static constexpr bool kRotates = Joint::kRotates, kTranslates = Joint::kTranslates, kHasDrift = true;

  Joint joint;

  template <class T>
  void calc_across(double t, const T* q, AcrossJoint<kNv, T>& out) const {
    AcrossJoint<kNv, T> forward;
    joint.calc_across(t, q, forward);
    const Matrix3T<T> R_MF = forward.X_FM.R.transpose();
    out.X_FM = forward.X_FM.inverse();
    for (int i = 0; i < kNv; ++i) {
      const Vector3T<T> w = forward.H.col(i).template head<3>(), v = forward.H.col(i).template tail<3>();
      out.H.col(i) << -(R_MF * w), -(R_MF * (v - w.cross(forward.X_FM.p)));
    }
  }

  template <class T>
  void calc_drift(double t, const T* q, const T* speeds, Vector6T<T>& V_drift, Vector6T<T>& A_drift) const {
    AcrossJoint<kNv, T> forward;
    joint.calc_across(t, q, forward);
    Vector6T<T> V0 = Vector6T<T>::Zero(), A0 = Vector6T<T>::Zero();
    if constexpr (Joint::kHasDrift) joint.calc_drift(t, q, speeds, V0, A0);

    const Matrix3T<T> R_MF = forward.X_FM.R.transpose();
    const Vector3T<T>& p = forward.X_FM.p;
    const Vector6T<T> V = forward.H * Eigen::Map<const Eigen::Matrix<T, kNv, 1>>(speeds) + V0;
    const Vector3T<T> w = V.template head<3>(), v = V.template tail<3>();
    const Vector3T<T> w0 = V0.template head<3>(), v0 = V0.template tail<3>();
    const Vector3T<T> alpha = A0.template head<3>(), a = A0.template tail<3>();
    V_drift << -(R_MF * w0), -(R_MF * (v0 - w0.cross(p)));
    A_drift << -(R_MF * alpha), -(R_MF * (a - alpha.cross(p) - 2.0 * w.cross(v) + w.cross(w.cross(p))));
  }

  template <class T>
  void calc_q_rate(const T* q, const T* v, T* q_rate) const {
    joint.calc_q_rate(q, v, q_rate);
  }
  void retract(const double* d, double* q) const { joint.retract(d, q); }
  void calc_displacement(const double* q0, const double* q, double* d) const {
    joint.calc_displacement(q0, q, d);
  }
  void set_neutral(double* q) const { joint.set_neutral(q); }
  Joint reversed() const { return joint; }
};

}  // namespace wishbone
