#pragma once

#include <variant>

#include "joints/fixed_joint.h"
#include "joints/free_joint.h"
#include "joints/prescribed_joint.h"
#include "joints/prismatic_joint.h"
#include "joints/revolute_joint.h"
#include "joints/spherical_joint.h"

namespace wishbone {

/// Every tree joint. A new one is a header beside these and one entry here.
using TreeJoint =
    std::variant<FixedJoint, RevoluteJoint, PrismaticJoint, SphericalJoint, FreeJoint, PrescribedJoint>;

inline int coordinate_count(const TreeJoint& joint) {
  return std::visit([](const auto& j) { return j.kNq; }, joint);
}
inline int speed_count(const TreeJoint& joint) {
  return std::visit([](const auto& j) { return j.kNv; }, joint);
}

}  // namespace wishbone
