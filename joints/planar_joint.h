#pragma once

#include <tuple>

#include "joints/additive_coordinates.h"
#include "joints/joint_motion.h"

namespace wishbone {

/// Motion in a plane fixed in F: q = (x along first [m], y along second [m], angle about the plane's normal [rad]), v = q'.
struct PlanarJoint : AdditiveCoordinates<3> {
  static constexpr const char* kKind = "planar";
  static constexpr bool kRotates = true, kTranslates = true, kHasDrift = false;

  Vector3 axis_F = Vector3::UnitZ();   ///< unit normal, fixed in F and M
  Vector3 first_F = Vector3::UnitX();  ///< (axis, first, second) is a right-handed triad
  Vector3 second_F = Vector3::UnitY();

  PlanarJoint() = default;
  /// Directions in the plane are chosen.
  explicit PlanarJoint(const Vector3& normal) : axis_F(normal) {
    std::tie(first_F, second_F) = perpendiculars(normal);
  }
  /// Directions in the plane are given: two perpendicular unit vectors.
  PlanarJoint(const Vector3& first, const Vector3& second)
      : axis_F(first.cross(second)), first_F(first), second_F(second) {}

  template <class T>
  void calc_across(double /*t*/, const T* q, AcrossJoint<kNv, T>& out) const {
    out.X_FM.R = rotation_about(axis_F, q[2]);
    out.X_FM.p = first_F.cast<T>() * q[0] + second_F.cast<T>() * q[1];
    out.H.template block<3, 1>(3, 0) = first_F.cast<T>();
    out.H.template block<3, 1>(3, 1) = second_F.cast<T>();
    out.H.template block<3, 1>(0, 2) = axis_F.cast<T>();
  }
};

}  // namespace wishbone
