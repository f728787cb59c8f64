#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Index of a marker: a frame M fixed to a body (or, on a flexible body, to one of its interfaces) at which
/// joints and forces take hold. Everything outside `bodies` and the recursions sees bodies only through markers.
using MarkerIndex = int;

/// Motion of a marker, world components.
template <class T>
struct MarkerStateT {
  Matrix3T<T> R_WM = Matrix3T<T>::Identity();
  Vector3T<T> p_WM = Vector3T<T>::Zero();  ///< [m]
  Vector3T<T> w_WM = Vector3T<T>::Zero();  ///< angular velocity [rad/s]
  Vector3T<T> v_WM = Vector3T<T>::Zero();  ///< velocity of Mo [m/s]
};
using MarkerState = MarkerStateT<double>;

/// Acceleration of a marker, world components.
template <class T>
struct MarkerAccelerationT {
  Vector3T<T> alpha = Vector3T<T>::Zero();  ///< angular [rad/s^2]
  Vector3T<T> a = Vector3T<T>::Zero();      ///< of Mo [m/s^2]
};
using MarkerAcceleration = MarkerAccelerationT<double>;

/// Force and moment that act on the body at a marker's origin, world components.
template <class T>
struct WrenchT {
  Vector3T<T> t = Vector3T<T>::Zero();  ///< moment about Mo [N m]
  Vector3T<T> f = Vector3T<T>::Zero();  ///< force [N]
};
using Wrench = WrenchT<double>;

}  // namespace wishbone
