#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Index of a marker: a frame M fixed to a body (or, on a flexible body, to one of its interface nodes) at which
/// joints and forces take hold. Everything outside `bodies` and the recursions sees bodies only through markers.
using MarkerIndex = int;

/// Motion of a marker, world components.
struct MarkerState {
  Matrix3 R_WM = Matrix3::Identity();
  Vector3 p_WM = Vector3::Zero();  ///< [m]
  Vector3 w_WM = Vector3::Zero();  ///< angular velocity [rad/s]
  Vector3 v_WM = Vector3::Zero();  ///< velocity of Mo [m/s]
};

/// Force and moment that act on the body at a marker's origin, world components.
struct Wrench {
  Vector3 t = Vector3::Zero();  ///< moment about Mo [N m]
  Vector3 f = Vector3::Zero();  ///< force [N]
};

}  // namespace wishbone
