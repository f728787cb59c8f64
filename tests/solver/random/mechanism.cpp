#include "solver/random/mechanism.h"

#include <stdexcept>
#include <string>

namespace wishbone::testing {
namespace {

/// The joint with the axes R, given in the frame of its second-named body.
TreeJoint tree_joint(const Mechanism::Joint& joint, const Matrix3& R) {
  const Vector3 x = R.col(0), y = R.col(1), z = R.col(2);
  switch (joint.kind) {
    case JointKind::fixed:
      return FixedJoint{};
    case JointKind::revolute:
      return RevoluteJoint{z};
    case JointKind::prismatic:
      return PrismaticJoint{z};
    case JointKind::cylindrical:
      return CylindricalJoint{z};
    case JointKind::screw:
      return ScrewJoint{z, joint.pitch};
    case JointKind::universal:
      return UniversalJoint{x, y};
    case JointKind::constant_velocity:
      return ConstantVelocityJoint{x, y};
    case JointKind::spherical:
      return SphericalJoint{};
    case JointKind::planar:
      return PlanarJoint{x, y};
    case JointKind::free:
      return FreeJoint{};
  }
  throw std::logic_error("a joint of no kind");
}

void add_joint(const Mechanism& mechanism, int child, SystemBuilder& builder) {
  const Mechanism::Joint& joint = mechanism.joints[child];
  const int second = joint.reversed ? joint.parent : child;
  const Matrix3 R_WS = second < 0 ? Matrix3::Identity() : mechanism.bodies[second].X_WB.R;
  const TreeJoint forward = tree_joint(joint, R_WS.transpose() * joint.X_WJ.R);
  builder.add_joint("joint " + std::to_string(child), {joint.parent}, child, joint.X_WJ.p,
                    joint.reversed ? reverse(forward) : forward, SystemBuilder::InitialMotion{},
                    joint.reversed);
}

}  // namespace

SystemBuilder builder_of(const Mechanism& mechanism) {
  SystemBuilder builder;
  builder.gravity = mechanism.gravity;
  const auto count = static_cast<int>(mechanism.bodies.size());
  for (int i = 0; i < count; ++i) {
    const Mechanism::Body& body = mechanism.bodies[i];
    builder.add_body("body " + std::to_string(i), body.mass, body.J_B, body.X_WB);
  }
  for (int i = 0; i < count; ++i) add_joint(mechanism, i, builder);
  for (std::size_t i = 0; i < mechanism.closures.size(); ++i) {
    const Mechanism::Closure& c = mechanism.closures[i];
    builder.add_closure("closure " + std::to_string(i), builder.add_marker({c.A}, c.X_WA.p, c.X_WA.R),
                        builder.add_marker({c.B}, c.p_WB, c.X_WA.R), c.joint);
  }
  for (std::size_t i = 0; i < mechanism.springs.size(); ++i) {
    const Mechanism::Spring& s = mechanism.springs[i];
    builder.add_force(SpringDamper("spring " + std::to_string(i), builder.add_marker({s.P}, s.p_WP),
                                   builder.add_marker({s.Q}, s.p_WQ), s.stiffness, s.damping, s.free_length));
  }
  return builder;
}

}  // namespace wishbone::testing
