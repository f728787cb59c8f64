#pragma once

#include <string>

#include "bodies/gauge.h"

namespace wishbone {

/// A speed that is given at the start [m/s, rad/s]: one of v, or, where v has no such entry (of cut joints, of bodies that
/// joints carry), a component of the motion between two markers.
struct GivenSpeed {
  enum class Of {
    speed,       ///< v itself
    coordinate,  ///< rate of `gauge`
    turning,     ///< w_AB along an axis of B
    travel       ///< v_WB along an inertial axis; A is on the ground
  };
  std::string name;   ///< for messages: "joint 'crank'", "body 'rotor' (angular_velocity z)"
  std::string where;  ///< place in the scene file; empty: none
  double value = 0;
  bool is_angle = true;  ///< [rad/s] rather than [m/s]
  Of of = Of::speed;
  int index =
      0;  ///< of the speed in v; while a system is built, among those of the joint that carries `body`
  int body = -1;  ///< while a system is built, of a speed
  int axis = 0;   ///< of `turning` and `travel`
  Gauge gauge;
  MarkerIndex A = 0, B = 0;

  /// W_A, W_B with rate = W_A . V_A + W_B . V_B, about the markers' origins, world axes; not of a speed.
  void wrenches(const MarkerState& on_A, const MarkerState& on_B, Vector6& W_A, Vector6& W_B) const {
    W_A.setZero();
    W_B.setZero();
    if (of == Of::coordinate) return gauge.wrenches(on_A, on_B, W_A, W_B);
    if (of == Of::travel) {
      W_B[3 + axis] = 1;
      return;
    }
    W_B.head<3>() = on_B.R_WM.col(axis);
    W_A.head<3>() = -on_B.R_WM.col(axis);
  }
};

}  // namespace wishbone
