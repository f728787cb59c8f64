#pragma once

#include <cmath>
#include <numbers>

#include "bodies/marker.h"
#include "core/dual.h"

namespace wishbone {

/// A scalar measured between two markers A and B: a coordinate of the joint between them, whether that joint carries a
/// body, closes a loop, or is not there at all. Springs, friction, limits, drivers and couplings act through gauges.
///
///     value(A, B, near)    u; an angle is given on the turn that is nearest to `near`
///     rate(A, B)           u' = W_A . V_A + W_B . V_B
///     wrenches(A, B, ...)  W_A, W_B: what a unit force along u (N, or N m about an axis) puts on A and B, about their
///                          origins, world axes
///     acceleration(...)    u'' for given marker accelerations
///
/// Rates of angles hold while the joint's axes are aligned, as its other rows keep them.
struct Gauge {
  enum class Kind {
    rotation,          ///< of B about the z axis of A [rad]
    translation,       ///< of Bo along `axis` of A [m]
    universal_first,   ///< R_AB = Rx(u) Ry(.): about the x axis of A [rad]
    universal_second,  ///< R_AB = Rx(.) Ry(u): about the y axis of B [rad]
    distance           ///< |p_AB| [m]
  };
  Kind kind = Kind::rotation;
  int axis = 2;  ///< of a translation: 0 x, 1 y, 2 z

  bool is_angle() const { return kind != Kind::translation && kind != Kind::distance; }

  template <class T>
  T value(const MarkerStateT<T>& A, const MarkerStateT<T>& B, double near) const {
    switch (kind) {
      case Kind::translation:
        return A.R_WM.col(axis).dot(B.p_WM - A.p_WM);
      case Kind::distance:
        return length(Vector3T<T>(B.p_WM - A.p_WM));
      case Kind::rotation:
        return angle(A.R_WM.col(1).dot(B.R_WM.col(0)), A.R_WM.col(0).dot(B.R_WM.col(0)), near);
      case Kind::universal_first:
        return angle(A.R_WM.col(2).dot(B.R_WM.col(1)), A.R_WM.col(1).dot(B.R_WM.col(1)), near);
      case Kind::universal_second:
        return angle(B.R_WM.col(2).dot(A.R_WM.col(0)), B.R_WM.col(0).dot(A.R_WM.col(0)), near);
    }
    return T(0);
  }

  template <class T>
  T rate(const MarkerStateT<T>& A, const MarkerStateT<T>& B) const {
    if (is_angle()) return direction(A, B).dot(B.w_WM - A.w_WM);
    // k . (v_B - v_A - w_A x d); along d itself the last term vanishes
    const Vector3T<T> d = B.p_WM - A.p_WM;
    return direction(A, B).dot(B.v_WM - A.v_WM - A.w_WM.cross(d));
  }

  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, Vector6T<T>& W_A,
                Vector6T<T>& W_B) const {
    const Vector3T<T> k = direction(A, B);
    const Vector3T<T> zero = Vector3T<T>::Zero();
    if (is_angle()) {
      W_A << -k, zero;
      W_B << k, zero;
    } else {
      const Vector3T<T> d = B.p_WM - A.p_WM;
      W_A << -d.cross(k), -k;
      W_B << zero, k;
    }
  }

  template <class T>
  T acceleration(const MarkerStateT<T>& A, const MarkerStateT<T>& B, const MarkerAccelerationT<T>& a_A,
                 const MarkerAccelerationT<T>& a_B) const {
    const Vector3T<T> k = direction(A, B);
    if (is_angle()) {
      // u' = k . w_AB with k fixed in A, or in B for the second angle of a universal joint
      const Vector3T<T>& w_k = kind == Kind::universal_second ? B.w_WM : A.w_WM;
      return k.dot(a_B.alpha - a_A.alpha) + w_k.cross(k).dot(B.w_WM - A.w_WM);
    }
    const Vector3T<T> d = B.p_WM - A.p_WM, d_rate = B.v_WM - A.v_WM;
    if (kind == Kind::distance) {
      // (d.d)'' = 2 (u'^2 + u u'')
      const T u = length(d), u_rate = k.dot(d_rate);
      return (d_rate.squaredNorm() - u_rate * u_rate) / u + k.dot(a_B.a - a_A.a);
    }
    // k . d'' seen from A: d'' - alpha_A x d - 2 w_A x d' + w_A x (w_A x d)
    return k.dot(a_B.a - a_A.a - a_A.alpha.cross(d) - 2.0 * A.w_WM.cross(d_rate) +
                 A.w_WM.cross(A.w_WM.cross(d)));
  }

 private:
  template <class T>
  static T length(const Vector3T<T>& d) {
    using std::sqrt;
    return sqrt(d.squaredNorm());
  }
  template <class T>
  static T angle(const T& sine, const T& cosine, double near) {
    using std::atan2;
    const T u = atan2(sine, cosine);
    return u + 2 * std::numbers::pi * std::round((near - value_of(u)) / (2 * std::numbers::pi));
  }
  /// Unit vector along which, or about which, u grows; world axes.
  template <class T>
  Vector3T<T> direction(const MarkerStateT<T>& A, const MarkerStateT<T>& B) const {
    switch (kind) {
      case Kind::rotation:
        return A.R_WM.col(2);
      case Kind::translation:
        return A.R_WM.col(axis);
      case Kind::universal_first:
        return A.R_WM.col(0);
      case Kind::universal_second:
        return B.R_WM.col(1);
      case Kind::distance:
        break;
    }
    const Vector3T<T> d = B.p_WM - A.p_WM;
    return d / length(d);
  }
};

}  // namespace wishbone
