#pragma once

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Rotation about an axis fixed in F and M, and translation along it: q = (angle [rad], travel [m]), v = q'.
struct CylindricalJoint : AdditiveCoordinates<2> {
  static constexpr const char* kKind = "cylindrical";
  static constexpr bool kRotates = true, kTranslates = true, kHasDrift = false;

  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector

  CylindricalJoint() = default;
  explicit CylindricalJoint(const Vector3& axis) : axis_F(axis) {}

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.R = rotation_about(axis_F, q[0]);
    out.X_FM.p = axis_F.cast<T>() * q[1];
    out.H.template block<3, 1>(0, 0) = axis_F.cast<T>();
    out.H.template block<3, 1>(3, 1) = axis_F.cast<T>();
  }
  CylindricalJoint reversed() const { return CylindricalJoint(-axis_F); }
};

}  // namespace wishbone
