#pragma once

#include <string>
#include <vector>

#include "core/function.h"
#include "forces/joint_coordinate.h"

namespace wishbone {

/// Force or torque along a joint's coordinate u that is a given function of time and signals, as of a motor
/// or an actuator: f > 0 pushes u to grow. It stores no energy: all its power f u' counts as input.
class JointDrive {
 public:
  /// @param force f [N m or N]
  /// @throws InputError naming the element when a constant force is not finite or A and B are one marker
  JointDrive(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, Function force);

  const std::string& name() const { return coordinate_.name(); }
  const Gauge& gauge() const { return coordinate_.gauge(); }
  int state_count() const { return 0; }
  std::vector<MarkerIndex> markers() const { return coordinate_.markers(); }
  std::vector<int> variables() const { return force_.variables(); }
  std::vector<double> stop_times() const { return force_.stop_times(); }

  /// @throws NumericsError naming the element and the time when the force is not finite
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput&) const { return 0; }
  /// u, on the turn nearest to the last one [rad or m].
  double angle(const ForceInput& input) const { return coordinate_.value(input); }
  JointForceOutput output(const ForceInput& input) const;

 private:
  JointCoordinate coordinate_;
  Function force_;
};

}  // namespace wishbone
