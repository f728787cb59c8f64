#pragma once

#include <string>
#include <vector>

#include "forces/joint_coordinate.h"

namespace wishbone {

/// Spring and damper in parallel on a joint's coordinate u, torsional or translational:
///     f = -(k (u - u0) + c u'),   f > 0 pushes u to grow;   energy k (u - u0)^2/2.
/// The angle counts whole turns.
class JointSpring {
 public:
  /// @param stiffness k >= 0 [N m/rad or N/m]  @param damping c >= 0 [N m s/rad or N s/m]
  /// @param free_value u0 [rad or m], where the spring is relaxed
  /// @throws InputError naming the element when a value is out of range or A and B are one marker
  JointSpring(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, double stiffness, double damping,
              double free_value);

  const std::string& name() const { return coordinate_.name(); }
  std::vector<MarkerIndex> markers() const { return coordinate_.markers(); }
  const Gauge& gauge() const { return coordinate_.gauge(); }
  double stiffness() const { return stiffness_; }
  double free_value() const { return free_value_; }
  /// For preloading, where the free value is solved for; any finite value [rad or m].
  void set_free_value(double free_value) { free_value_ = free_value; }

  int state_count() const { return 0; }
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput& input) const;
  /// u, on the turn nearest to the last one [rad or m].
  double angle(const ForceInput& input) const { return coordinate_.value(input); }
  JointForceOutput output(const ForceInput& input) const;

 private:
  template <class T>
  T force(const T& u, const T& rate) const {
    return -(stiffness_ * (u - free_value_) + damping_ * rate);
  }

  JointCoordinate coordinate_;
  double stiffness_, damping_, free_value_;
};

}  // namespace wishbone
