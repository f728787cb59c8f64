#pragma once

namespace wishbone {

/// What joints have in common whose coordinates are plain numbers and whose speeds are their rates, q' = v.
template <int n>
struct AdditiveCoordinates {
  static constexpr int kNq = n;
  static constexpr int kNv = n;

  template <class T>
  void calc_q_rate(const T* /*q*/, const T* v, T* q_rate) const {
    for (int i = 0; i < n; ++i) q_rate[i] = v[i];
  }
  void retract(const double* d, double* q) const {
    for (int i = 0; i < n; ++i) q[i] += d[i];
  }
  void calc_displacement(const double* q0, const double* q, double* d) const {
    for (int i = 0; i < n; ++i) d[i] = q[i] - q0[i];
  }
  void set_neutral(double* q) const {
    for (int i = 0; i < n; ++i) q[i] = 0;
  }
};

}  // namespace wishbone
