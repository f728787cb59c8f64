#pragma once

#include <optional>
#include <string>
#include <vector>

#include "forces/joint_coordinate.h"

namespace wishbone {

/// Dry friction that falls from a peak at rest to the sliding value: F(u') = F_c + (F_s - F_c) exp(-(u'/v_st)^2).
struct StribeckPeak {
  double force = 0;     ///< F_s >= F_c [N m or N]
  double velocity = 0;  ///< v_st > 0 [rad/s or m/s]
};

/// Dry and viscous friction on a joint's coordinate u, dry friction regularised so that the force is smooth through rest:
///     f = -(F tanh(u'/v_s) + c u'),   F = F_c, or F(u') of StribeckPeak;   f > 0 pushes u to grow.
/// It takes power at any rate and stores none. Within about v_s of rest it creeps instead of sticking.
class JointFriction {
 public:
  /// @param coulomb F_c >= 0 [N m or N]  @param smoothing v_s > 0 [rad/s or m/s]
  /// @param viscous c >= 0 [N m s/rad or N s/m]
  /// @throws InputError naming the element when a value is out of range or A and B are one marker
  JointFriction(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, double coulomb, double smoothing,
                double viscous, std::optional<StribeckPeak> peak = std::nullopt);

  const std::string& name() const { return coordinate_.name(); }
  std::vector<MarkerIndex> markers() const { return coordinate_.markers(); }
  const Gauge& gauge() const { return coordinate_.gauge(); }

  int state_count() const { return 0; }
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput&) const { return 0; }
  /// u, on the turn nearest to the last one [rad or m].
  double angle(const ForceInput& input) const { return coordinate_.value(input); }
  JointForceOutput output(const ForceInput& input) const;

 private:
  template <class T>
  T force(const T& rate) const;

  JointCoordinate coordinate_;
  double coulomb_, smoothing_, viscous_;
  std::optional<StribeckPeak> peak_;
};

}  // namespace wishbone
