#pragma once

#include <span>

#include "bodies/marker.h"

namespace wishbone {

/// What every force element is given in one evaluation.
template <class T>
struct ForceInputT {
  double time = 0;                                ///< [s]
  std::span<const MarkerStateT<T>> markers = {};  ///< by MarkerIndex
  std::span<const T> states = {};  ///< states of the element's own (tire lag, ...); empty when it has none
  int segment = 0;   ///< the element's discrete state (road segment of a tire, ...), changed only by events
  double angle = 0;  ///< the angle that the element's gauge had last, from which turns are counted [rad]
  /// Of functions (core/function.h): the time, then the system's signals (forces/motion_signal.h).
  std::span<const T> variables = {};
};
using ForceInput = ForceInputT<double>;

/// Where every force element adds its result.
template <class T>
struct ForceOutputT {
  std::span<WrenchT<T>> wrenches;  ///< by MarkerIndex; add to them
  std::span<T> state_rates;        ///< of the element's own states; set them
  T power = T(0);                  ///< set: power that the element delivers to the bodies, sum f.v + t.w [W]
};
using ForceOutput = ForceOutputT<double>;

/// Where a segment begins and ends; infinite at the outer ones.
struct Edges {
  double lower, upper;
};

/// The contract of a force element (a concept, not a base class: the evaluation calls concrete types, without
/// virtual dispatch). A type F in the room `forces` has
///
///     template <class T>                                     // T: double, or Dual for exact derivatives
///     void apply(const ForceInputT<T>&, ForceOutputT<T>&) const;  // adds wrenches, sets power and state rates; no allocation
///     double energy(const ForceInput&) const;                // recoverable energy stored now [J]; zero if none
///     int state_count() const;                               // number of states of its own
///     std::vector<MarkerIndex> markers() const;              // that it looks at or acts on
///     const std::string& name() const;
///
/// and, where it has them,
///
///     std::vector<int> variables() const;                    // of its functions, see ForceInputT::variables
///     std::vector<double> stop_times() const;                // at which it is only piecewise smooth [s]
///     double angle(const ForceInput&) const;                 // of its gauge, from which turns are counted [rad]
///
/// An element whose law is smooth only between edges of one position has segments: while a step is taken the law of
/// ForceInputT::segment holds, also a little beyond its edges, and passing an edge is an event (solver/events.h):
///
///     bool has_segments() const;                             // whether there is more than one
///     double position(const ForceInput&) const;
///     int segment_at(double position) const;
///     Edges edges(int segment) const;
///
/// Throws NumericsError naming itself, the time and the value when its law is undefined at the given state.

}  // namespace wishbone
