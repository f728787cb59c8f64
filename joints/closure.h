#pragma once

#include <span>

#include "bodies/gauge.h"
#include "bodies/marker.h"

namespace wishbone {

/// What the participants of a closure see of an array over all markers.
template <class Item>
class Participants {
 public:
  Participants(std::span<const Item> all, std::span<const MarkerIndex> markers)
      : all_(all), markers_(markers) {}
  const Item& operator[](int participant) const { return all_[markers_[participant]]; }

 private:
  std::span<const Item> all_;
  std::span<const MarkerIndex> markers_;
};

/// The states of the markers that a closure joins: 0 = A, 1 = B, and further pairs for a coupling.
template <class T>
using Sides = Participants<MarkerStateT<T>>;
template <class T>
using MarkerAccelerations = Participants<MarkerAccelerationT<T>>;

/// A cut joint closes a loop by rows Phi = 0 between its participants. Its contract (a concept); T is the scalar,
/// double or Dual:
///
///     static constexpr const char* kKind;                            "revolute", ...
///     static constexpr int kRows;
///     static constexpr std::array<const char*, kRows> kDirections;   names of the rows, for messages
///     bool row_is_angle(int row) const;                              rad rather than m; angles come last
///     int participant_count() const;
///     int gauge_count() const;  const Gauge& gauge(int) const;       gauge i lies between participants 2 i and 2 i + 1
///     const Motion* drive() const;                                   what it follows; nullptr: nothing
///
///     void residual(double t, Sides<T>, const double* near, T* Phi) const;
///     void wrenches(Sides<T>, T* W) const;
///     void time_rate(double t, T* Phi_t) const;
///     void acceleration(double t, Sides<T>, MarkerAccelerations<T>, T* Phi_dd) const;
///
/// `near` are the angles of its gauges from which turns are counted (bodies/gauge.h). W is 6 x (participants rows),
/// column-major: column p kRows + i is the (moment, force) that a unit multiplier of row i puts on participant p, about
/// its marker's origin, world axes. By virtual power
///     Phi' = D v + Phi_t,   D v = sum_p W_p^T V_p,
/// and Phi_dd is the complete second derivative for the given marker accelerations, driven terms included.
///
/// Rows are written in the axes of A: a direction that is redundant in one pose of a mechanism is then redundant in all
/// of them.

}  // namespace wishbone
