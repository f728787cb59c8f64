#pragma once

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Rotation by the angle q [rad] about an axis fixed in F and M; v = q' [rad/s].
struct RevoluteJoint : AdditiveCoordinates<1> {
  static constexpr const char* kKind = "revolute";
  static constexpr bool kRotates = true, kTranslates = false, kHasDrift = false;

  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector

  RevoluteJoint() = default;
  explicit RevoluteJoint(const Vector3& axis) : axis_F(axis) {}

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.R = rotation_about(axis_F, q[0]);
    out.H.template head<3>() = axis_F.cast<T>();
  }
  RevoluteJoint reversed() const { return RevoluteJoint(-axis_F); }
};

}  // namespace wishbone
