#pragma once

#include <string>
#include <vector>

#include "bodies/gauge_domain.h"
#include "core/require.h"
#include "forces/force_element.h"

namespace wishbone {

/// What a force on a joint's coordinate reports.
struct JointForceOutput {
  double value = 0;  ///< u [rad or m]
  double rate = 0;   ///< u' [rad/s or m/s]
  double force = 0;  ///< f [N m or N], > 0 pushes u to grow
};

/// The coordinate u between two markers on which a joint force acts, and the part that all such forces share: they differ in
/// their law f(u, u') alone. Virtual power: f u' = sum over both markers of the wrench times the velocity.
class JointCoordinate {
 public:
  /// @throws InputError naming the element if A and B are one marker
  JointCoordinate(std::string element, MarkerIndex A, MarkerIndex B, Gauge gauge)
      : name_(std::move(element)), A_(A), B_(B), gauge_(gauge) {
    require(A != B, name_, "a joint force needs two different markers", A,
            "attach it to the markers of a joint");
  }

  const std::string& name() const { return name_; }
  const Gauge& gauge() const { return gauge_; }
  std::vector<MarkerIndex> markers() const { return {A_, B_}; }

  template <class T>
  T value(const ForceInputT<T>& input) const {
    return gauge_.value(input.markers[A_], input.markers[B_], input.angle);
  }

  /// Adds the wrenches of f = law(u, u') and sets the power.
  /// @throws NumericsError naming the element where u is a distance that has shrunk to zero
  template <class T, class Law>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output, const Law& law) const {
    const MarkerStateT<T>& A = input.markers[A_];
    const MarkerStateT<T>& B = input.markers[B_];
    require_defined(gauge_, A, B, name_);
    const T rate = gauge_.rate(A, B);
    const T f = law(value(input), rate);
    Vector6T<T> W_A, W_B;
    gauge_.wrenches(A, B, W_A, W_B);
    add(W_A, f, output.wrenches[A_]);
    add(W_B, f, output.wrenches[B_]);
    output.power = f * rate;
  }

  template <class Law>
  JointForceOutput output(const ForceInput& input, const Law& law) const {
    require_defined(gauge_, input.markers[A_], input.markers[B_], name_);
    const double u = value(input), rate = gauge_.rate(input.markers[A_], input.markers[B_]);
    return {u, rate, law(u, rate)};
  }

 private:
  template <class T>
  static void add(const Vector6T<T>& W, const T& f, WrenchT<T>& wrench) {
    wrench.t += angular(W) * f;
    wrench.f += linear(W) * f;
  }

  std::string name_;
  MarkerIndex A_, B_;
  Gauge gauge_;
};

}  // namespace wishbone
