#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bodies/gauge_domain.h"
#include "core/require.h"

namespace wishbone {

/// A scalar of the motion by name, on which loads may depend: the coordinate of a gauge between two markers
/// or its rate, or one world component of a marker's position or velocity.
class MotionSignal {
 public:
  enum class Quantity { position, speed };

  /// u [rad or m], or u' [rad/s or m/s], of a gauge between A and B. An angle counts whole turns.
  /// @throws InputError naming the signal if A and B are one marker
  MotionSignal(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, Quantity quantity)
      : name_(std::move(name)), A_(A), B_(B), gauge_(gauge), is_gauge_(true), quantity_(quantity) {
    require(A != B, name_, "a signal is measured between two different markers", A, "name two points");
  }

  /// Component `axis` (0 x, 1 y, 2 z, world axes) of p_WM [m] or v_WM [m/s].
  /// @throws InputError naming the signal if there is no such axis
  MotionSignal(std::string name, MarkerIndex marker, int axis, Quantity quantity)
      : name_(std::move(name)), A_(marker), B_(marker), axis_(axis), quantity_(quantity) {
    require(axis >= 0 && axis <= 2, name_, "a component is one of three", axis, "give 0, 1 or 2");
  }

  const std::string& name() const { return name_; }
  std::vector<MarkerIndex> markers() const { return is_gauge_ ? std::vector{A_, B_} : std::vector{A_}; }

  /// @param near the angle that it had last
  /// A distance has a kink at zero, where both points meet: its rate there is that with which they part, |v_AB|.
  template <class T>
  T value(std::span<const MarkerStateT<T>> markers, double near) const {
    const MarkerStateT<T>&A = markers[static_cast<std::size_t>(A_)],
          &B = markers[static_cast<std::size_t>(B_)];
    const bool is_speed = quantity_ == Quantity::speed;
    if (!is_gauge_) return is_speed ? A.v_WM[axis_] : A.p_WM[axis_];
    if (gauge_.kind == Gauge::Kind::distance && !((B.p_WM - A.p_WM).squaredNorm() > 0))
      return is_speed ? norm_or_zero(Vector3T<T>(B.v_WM - A.v_WM)) : T(0);
    return is_speed ? gauge_.rate(A, B) : gauge_.value(A, B, near);
  }

 private:
  std::string name_;
  MarkerIndex A_, B_;
  Gauge gauge_;
  bool is_gauge_ = false;
  int axis_ = 0;
  Quantity quantity_;
};

}  // namespace wishbone
