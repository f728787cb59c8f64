#pragma once

#include <tuple>
#include <vector>

#include "joints/cut_joint.h"
#include "joints/tree_joint.h"

namespace wishbone::testing {

inline Motion some_motion() {
  return Motion("drive", 0.3, {{0, 2, 1.5}, {0.5, 1, -0.4}});
}

/// One of each tree joint with oblique axes, and each of them reversed.
inline std::vector<TreeJoint> every_tree_joint(const Vector3& axis, const Vector3& normal_to_the_arms) {
  const auto [first, second] = perpendiculars(normal_to_the_arms);
  std::vector<TreeJoint> joints{FixedJoint{},
                                RevoluteJoint(axis),
                                PrismaticJoint(axis),
                                CylindricalJoint(axis),
                                ScrewJoint(axis, 0.3),
                                UniversalJoint(first, second),
                                ConstantVelocityJoint(axis),
                                PlanarJoint(axis),
                                SphericalJoint{},
                                FreeJoint{},
                                PrescribedJoint{PrescribedJoint::Kind::revolute, axis, some_motion()},
                                PrescribedJoint{PrescribedJoint::Kind::prismatic, axis, some_motion()}};
  for (std::size_t i = 0, n = joints.size(); i < n; ++i) joints.push_back(reverse(joints[i]));
  return joints;
}

/// One of each cut joint; driven ones with every gauge. All join two markers.
inline std::vector<CutJoint> every_cut_joint() {
  using enum Gauge::Kind;
  std::vector<CutJoint> joints{FixedClosure{},
                               RevoluteClosure{},
                               PrismaticClosure{},
                               ScrewClosure(0.13),
                               CylindricalClosure{},
                               UniversalClosure{},
                               ConstantVelocityClosure{},
                               SphericalClosure{},
                               PlanarClosure{},
                               PointOnLineClosure{},
                               PointOnPlaneClosure{},
                               DistanceClosure("rod", 0.8),
                               DistanceClosure("ram", some_motion())};
  for (const Gauge& gauge :
       {Gauge{rotation}, Gauge{translation, 1}, Gauge{universal_first}, Gauge{universal_second}})
    joints.push_back(DrivenClosure("driver", gauge, some_motion()));
  return joints;
}

/// A coupling of all gauges, each between two markers of its own.
inline CutJoint coupling_of_every_gauge() {
  using enum Gauge::Kind;
  return CouplingClosure("mixer",
                         {{{rotation}, 1.5},
                          {{translation, 0}, -0.7},
                          {{universal_first}, 0.4},
                          {{universal_second}, 2},
                          {{distance}, 1}},
                         0.2);
}

}  // namespace wishbone::testing
