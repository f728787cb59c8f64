#pragma once

#include <array>
#include <variant>

#include <cstdlib>
#include "joints/closure.h"

namespace wishbone {

/// A cut joint closes a loop between a marker A and a marker B by rows Phi = 0. Its contract (a concept):
///
///     static constexpr int kRows;
///     static constexpr int kAngles;                                  the last rows that are angles
///     static constexpr std::array<const char*, kRows> kDirections;   names of the rows, for messages
///     void residual(A, B, Phi)                      Phi
///     void wrenches(A, B, W_A, W_B)                 column i: the (moment, force) that a unit multiplier of row i puts
///                                                   on A and on B, about the markers' origins; by virtual power
///                                                   D v = W_A^T V_A + W_B^T V_B
///     void acceleration(A, B, a_A, a_B, Phi_dd)     second derivative of Phi for the given marker accelerations
///
/// Rows are written in the axes of A: a direction that is redundant in one pose of the vehicle is then redundant in
/// all of them.
struct SphericalClosure {
  static constexpr int kRows = 3;
  static constexpr int kAngles = 0;
  static constexpr std::array<const char*, 3> kDirections{"x", "y", "z"};
  int gauge_count() const { return 0; }
  const Gauge& gauge(int) const { std::abort(); }
  template <class T>
  void residual(double, Sides<T> s, const double*, T* Phi_out) const;
  template <class T>
  void wrenches(Sides<T> s, T* W) const;
  template <class T>
  void time_rate(double, T* Phi_t) const {
    for (int i = 0; i < kRows; ++i) Phi_t[i] = T(0);
  }
  template <class T>
  void acceleration(double, Sides<T> s, MarkerAccelerations<T> a, T* Phi_dd_out) const;
};
struct RevoluteClosure {
  static constexpr int kRows = 5;
  static constexpr int kAngles = 2;
  static constexpr std::array<const char*, 5> kDirections{"x", "y", "z", "tilt about y", "tilt about x"};
  int gauge_count() const { return 0; }
  const Gauge& gauge(int) const { std::abort(); }
  template <class T>
  void residual(double, Sides<T> s, const double*, T* Phi_out) const;
  template <class T>
  void wrenches(Sides<T> s, T* W) const;
  template <class T>
  void time_rate(double, T* Phi_t) const {
    for (int i = 0; i < kRows; ++i) Phi_t[i] = T(0);
  }
  template <class T>
  void acceleration(double, Sides<T> s, MarkerAccelerations<T> a, T* Phi_dd_out) const;
};
/// Every cut joint. A new one is one entry here.
using CutJoint = std::variant<SphericalClosure, RevoluteClosure>;

inline int gauge_count(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.gauge_count(); }, joint);
}
inline bool is_driven(const CutJoint&) { return false; }
inline int row_count(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.kRows; }, joint);
}
/// Whether a row is an angle [rad] rather than a length [m]; a joint's angles come last.
inline bool row_is_angle(const CutJoint& joint, int row) {
  return std::visit([row](const auto& j) { return row >= j.kRows - j.kAngles; }, joint);
}
inline const char* row_direction(const CutJoint& joint, int row) {
  return std::visit([row](const auto& j) { return j.kDirections[row]; }, joint);
}

}  // namespace wishbone
