#pragma once

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Translation by q [m] along an axis fixed in F and M; v = q' [m/s].
struct PrismaticJoint : AdditiveCoordinates<1> {
  static constexpr const char* kKind = "prismatic";
  static constexpr bool kRotates = false, kTranslates = true, kHasDrift = false;

  Vector3 axis_F = Vector3::UnitZ();  ///< unit vector

  PrismaticJoint() = default;
  explicit PrismaticJoint(const Vector3& axis) : axis_F(axis) {}

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.p = axis_F.cast<T>() * q[0];
    out.H.template tail<3>() = axis_F.cast<T>();
  }
  PrismaticJoint reversed() const { return PrismaticJoint(-axis_F); }
};

}  // namespace wishbone
