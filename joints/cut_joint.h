#pragma once

#include <variant>

#include "joints/coupling.h"
#include "joints/driven_closure.h"
#include "joints/row_list.h"
#include "joints/rows/no_twist.h"
#include "joints/rows/offset.h"
#include "joints/rows/orientation_lock.h"
#include "joints/rows/perpendicular.h"
#include "joints/rows/screw_travel.h"

namespace wishbone {

/// Cut joints between a marker A on the first-named body and a marker B on the second; the contract is in
/// joints/closure.h. The axis of a joint is z of both markers.

/// B stays on A, axes and all.
struct FixedClosure : RowList<Offset<0>, Offset<1>, Offset<2>, OrientationLock> {
  static constexpr const char* kKind = "fixed";
};
/// B turns about z.
struct RevoluteClosure : RowList<Offset<0>, Offset<1>, Offset<2>, Perpendicular<0, 2>, Perpendicular<1, 2>> {
  static constexpr const char* kKind = "revolute";
};
/// B slides along z.
struct PrismaticClosure : RowList<Offset<0>, Offset<1>, OrientationLock> {
  static constexpr const char* kKind = "prismatic";
};
/// B turns about z and slides along it by `pitch` [m/rad] times the angle.
struct ScrewClosure : RowList<Offset<0>, Offset<1>, ScrewTravel, Perpendicular<0, 2>, Perpendicular<1, 2>> {
  static constexpr const char* kKind = "screw";
  explicit ScrewClosure(double pitch) : RowList({}, {}, {pitch}, {}, {}) {}
};
/// B turns about z and slides along it.
struct CylindricalClosure : RowList<Offset<0>, Offset<1>, Perpendicular<0, 2>, Perpendicular<1, 2>> {
  static constexpr const char* kKind = "cylindrical";
};
/// A cross joins x of A with y of B at right angles.
struct UniversalClosure : RowList<Offset<0>, Offset<1>, Offset<2>, Perpendicular<0, 1>> {
  static constexpr const char* kKind = "universal";
};
/// The shafts z bend but spin alike.
struct ConstantVelocityClosure : RowList<Offset<0>, Offset<1>, Offset<2>, NoTwist> {
  static constexpr const char* kKind = "constant_velocity";
};
/// The origins stay together.
struct SphericalClosure : RowList<Offset<0>, Offset<1>, Offset<2>> {
  static constexpr const char* kKind = "spherical";
};
/// B moves in the plane of A normal to z.
struct PlanarClosure : RowList<Offset<2>, Perpendicular<0, 2>, Perpendicular<1, 2>> {
  static constexpr const char* kKind = "planar";
};
/// The origin of B stays on the line through A along z of A.
struct PointOnLineClosure : RowList<Offset<0>, Offset<1>> {
  static constexpr const char* kKind = "point_on_line";
};
/// The origin of B stays in the plane through A normal to z of A.
struct PointOnPlaneClosure : RowList<Offset<2>> {
  static constexpr const char* kKind = "point_on_plane";
};

/// Every cut joint. A new one is a list of rows, or a class with the same contract, and one entry here.
using CutJoint =
    std::variant<FixedClosure, RevoluteClosure, PrismaticClosure, ScrewClosure, CylindricalClosure,
                 UniversalClosure, ConstantVelocityClosure, SphericalClosure, PlanarClosure,
                 PointOnLineClosure, PointOnPlaneClosure, DistanceClosure, DrivenClosure, CouplingClosure>;

inline int row_count(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.kRows; }, joint);
}
/// Whether a row is an angle [rad] rather than a length [m]; a joint's angles come last.
inline bool row_is_angle(const CutJoint& joint, int row) {
  return std::visit([row](const auto& j) { return j.row_is_angle(row); }, joint);
}
inline const char* row_direction(const CutJoint& joint, int row) {
  return std::visit([row](const auto& j) { return j.kDirections[row]; }, joint);
}
/// Number of markers it joins: two, or two for each gauge of a coupling.
inline int participant_count(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.participant_count(); }, joint);
}
inline int gauge_count(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.gauge_count(); }, joint);
}
inline const Gauge& gauge(const CutJoint& joint, int i) {
  return std::visit([i](const auto& j) -> const Gauge& { return j.gauge(i); }, joint);
}
/// The motion that it follows; nullptr: none.
inline const Motion* drive(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.drive(); }, joint);
}
/// Whether it depends on time, and so brings power.
inline bool is_driven(const CutJoint& joint) {
  return drive(joint) != nullptr;
}
/// Its name in scenes and reports: "revolute", ...
inline const char* joint_kind(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.kKind; }, joint);
}

}  // namespace wishbone
