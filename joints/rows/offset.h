#pragma once

#include <array>

#include "bodies/gauge.h"
#include "joints/rows/steady_rows.h"

namespace wishbone {

/// The origin of B has no offset along axis k of A: Phi = k_A . p_AB [m].
template <int k>
struct Offset : SteadyRows<1, 0> {
  static constexpr std::array<const char*, 1> kDirections{k == 0 ? "x" : k == 1 ? "y" : "z"};
  static constexpr Gauge kAlong{Gauge::Kind::translation, k};

  template <class T>
  void residual(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B, const double*, T* Phi) const {
    Phi[0] = kAlong.value(A, B, 0);
  }
  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W_A, T* W_B) const {
    // Phi' = k . (v_B - v_A - w_A x d), d = p_AB: both forces act at the origin of B
    const Vector3T<T> force = A.R_WM.col(k), d = B.p_WM - A.p_WM;
    Eigen::Map<Vector6T<T>>{W_A} << force.cross(d), -force;
    Eigen::Map<Vector6T<T>>{W_B} << Vector3T<T>::Zero(), force;
  }
  template <class T>
  void acceleration(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                    const MarkerAccelerationT<T>& a_A, const MarkerAccelerationT<T>& a_B, T* Phi_dd) const {
    Phi_dd[0] = kAlong.acceleration(A, B, a_A, a_B);
  }
};

}  // namespace wishbone
