#pragma once

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Rotation by the angle q [rad] about an axis fixed in F and M, with the travel pitch q along it; v = q' [rad/s].
struct ScrewJoint : AdditiveCoordinates<1> {
  static constexpr const char* kKind = "screw";
  static constexpr bool kRotates = true, kTranslates = true, kHasDrift = false;

  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector
  double pitch = 0;                   ///< travel per angle [m/rad], > 0 right-handed

  ScrewJoint() = default;
  ScrewJoint(const Vector3& axis, double travel_per_angle) : axis_F(axis), pitch(travel_per_angle) {}

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    const Vector3 travel_F = pitch * axis_F;
    out.X_FM.R = rotation_about(axis_F, q[0]);
    out.X_FM.p = travel_F.cast<T>() * q[0];
    out.H << axis_F.cast<T>(), travel_F.cast<T>();
  }
  /// Seen from the nut or from the bolt, a right-handed thread is right-handed.
  ScrewJoint reversed() const { return {-axis_F, pitch}; }
};

}  // namespace wishbone
