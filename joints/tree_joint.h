#pragma once

#include <variant>

#include "joints/constant_velocity_joint.h"
#include "joints/cylindrical_joint.h"
#include "joints/fixed_joint.h"
#include "joints/free_joint.h"
#include "joints/planar_joint.h"
#include "joints/prescribed_joint.h"
#include "joints/prismatic_joint.h"
#include "joints/reversed_joint.h"
#include "joints/revolute_joint.h"
#include "joints/screw_joint.h"
#include "joints/spherical_joint.h"
#include "joints/universal_joint.h"

namespace wishbone {

/// Every tree joint. A new one is a header beside these and one entry here.
using TreeJoint = std::variant<FixedJoint, RevoluteJoint, PrismaticJoint, CylindricalJoint, ScrewJoint,
                               UniversalJoint, ConstantVelocityJoint, PlanarJoint, SphericalJoint, FreeJoint,
                               PrescribedJoint, Reversed<UniversalJoint>, Reversed<PlanarJoint>,
                               Reversed<SphericalJoint>, Reversed<FreeJoint>>;

inline int coordinate_count(const TreeJoint& joint) {
  return std::visit([](const auto& j) { return j.kNq; }, joint);
}
inline int speed_count(const TreeJoint& joint) {
  return std::visit([](const auto& j) { return j.kNv; }, joint);
}
/// Its name in scenes and reports: "revolute", ...; reversed or not.
inline const char* joint_kind(const TreeJoint& joint) {
  return std::visit([](const auto& j) { return j.kKind; }, joint);
}

/// The same joint with the same coordinates and speeds, from its second-named body to its first-named one.
inline TreeJoint reverse(const TreeJoint& joint) {
  return std::visit(
      [](const auto& j) -> TreeJoint {
        if constexpr (requires { j.reversed(); }) {
          return j.reversed();
        } else {
          return Reversed<std::decay_t<decltype(j)>>{j};
        }
      },
      joint);
}

}  // namespace wishbone
