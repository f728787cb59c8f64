#pragma once

#include <optional>
#include <string>
#include <vector>

#include "forces/joint_coordinate.h"

namespace wishbone {

/// A stop against which a joint's coordinate comes to rest, [Hunt, Crossley 1975]: at the depth d > 0
///     f = k d^n (1 + beta d'),   never pulling;   energy k d^(n + 1)/(n + 1).
/// Its damping grows with the depth, so that the force sets in from zero.
struct Stop {
  double stiffness = 0;   ///< k > 0 [N m/rad^n or N/m^n]
  double exponent = 1.5;  ///< n >= 1
  /// beta >= 0 [s/rad or s/m]; restitution is about 1 - (2/3) beta times the speed of impact.
  double damping = 0;
};

/// Stops at a lower and an upper limit, or one of them, of a joint's coordinate u:
///     d = lower - u, f > 0 at the lower one;   d = u - upper, f < 0 at the upper one;   f > 0 pushes u to grow.
class JointLimit {
 public:
  /// @param lower, upper [rad or m], at least one, lower < upper
  /// @throws InputError naming the element when a value is out of range or A and B are one marker
  JointLimit(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, std::optional<double> lower,
             std::optional<double> upper, Stop stop);

  const std::string& name() const { return coordinate_.name(); }
  std::vector<MarkerIndex> markers() const { return coordinate_.markers(); }
  const Gauge& gauge() const { return coordinate_.gauge(); }

  int state_count() const { return 0; }
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput& input) const;
  /// u, on the turn nearest to the last one [rad or m].
  double angle(const ForceInput& input) const { return coordinate_.value(input); }
  JointForceOutput output(const ForceInput& input) const;

  // edges at the limits, positions u: in contact with the lower stop (segment 0), free (1), with the upper one (2)
  bool has_segments() const { return true; }
  double position(const ForceInput& input) const { return coordinate_.value(input); }
  int segment_at(double u) const;
  Edges edges(int segment) const;

 private:
  template <class T>
  T force(const T& u, const T& rate) const;
  template <class T>
  T contact(const T& depth, const T& depth_rate) const;

  JointCoordinate coordinate_;
  std::optional<double> lower_, upper_;
  Stop stop_;
};

}  // namespace wishbone
