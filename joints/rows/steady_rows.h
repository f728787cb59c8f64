#pragma once

#include "core/spatial.h"

namespace wishbone {

/// The contract of a row or a few rows between two markers A and B, of which cut joints are composed (a concept):
///
///     static constexpr int kRows, kAngles, kGauges;                  numbers of rows, of trailing angles, of gauges
///     static constexpr std::array<const char*, kRows> kDirections;
///     const Gauge& gauge() const;                                    if kGauges is 1
///     void residual(double t, A, B, const double* near, T* Phi) const;
///     void wrenches(A, B, T* W_A, T* W_B) const;                     6 x kRows each
///     void time_rate(double t, T* Phi_t) const;
///     void acceleration(double t, A, B, a_A, a_B, T* Phi_dd) const;
///
/// The meaning is that of joints/closure.h. This base is of rows that depend neither on time nor on turns.
template <int rows, int angles>
struct SteadyRows {
  static constexpr int kRows = rows;
  static constexpr int kAngles = angles;
  static constexpr int kGauges = 0;

  template <class T>
  void time_rate(double /*t*/, T* Phi_t) const {
    for (int i = 0; i < rows; ++i) Phi_t[i] = T(0);
  }
};

/// Writes opposite moments about n on A and on B: Phi' = n . (w_B - w_A).
template <class T>
void set_moments(const Vector3T<T>& n, T* W_A, T* W_B) {
  Eigen::Map<Vector6T<T>>{W_A} << -n, Vector3T<T>::Zero();
  Eigen::Map<Vector6T<T>>{W_B} << n, Vector3T<T>::Zero();
}

}  // namespace wishbone
