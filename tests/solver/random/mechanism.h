#pragma once

#include <vector>

#include "joints/cut_joint.h"
#include "joints/joint_kind.h"
#include "solver/mechanisms.h"

namespace wishbone::testing {

/// A mechanism of rigid bodies as plain data: everything stands where it is in the design pose, in inertial components.
/// Body -1 is the inertial frame.
struct Mechanism {
  static constexpr int kGround = -1;

  struct Body {
    double mass = 1;                    ///< [kg]
    Matrix3 J_B = Matrix3::Identity();  ///< about the mass centre, body axes [kg m^2]
    Pose X_WB;                          ///< origin at the mass centre
  };
  /// Carries body i of the list where it is joint i of the list.
  struct Joint {
    JointKind kind = JointKind::fixed;
    int parent = kGround;   ///< index smaller than that of the body carried
    bool reversed = false;  ///< named from the body carried to the parent
    Pose X_WJ;              ///< z its axis; of a universal joint x the first and y the second
    double pitch = 0;       ///< of a screw joint [m/rad]
  };
  /// Markers with equal axes at X_WA.p on A and p_WB on B.
  struct Closure {
    CutJoint joint;
    int A = kGround, B = kGround;
    Pose X_WA;
    Vector3 p_WB = Vector3::Zero();
  };
  struct Spring {
    int P = kGround, Q = kGround;
    Vector3 p_WP = Vector3::Zero(), p_WQ = Vector3::Zero();
    double stiffness = 0, damping = 0, free_length = 0;  ///< [N/m, N s/m, m]
  };

  Vector3 gravity = Vector3::Zero();  ///< [m/s^2]
  std::vector<Body> bodies;
  std::vector<Joint> joints;  ///< as many as bodies
  std::vector<Closure> closures;
  std::vector<Spring> springs;
};

/// Bodies, joints, closures and springs keep their order.
SystemBuilder builder_of(const Mechanism& mechanism);

inline Built build(const Mechanism& mechanism) {
  return build(builder_of(mechanism));
}

}  // namespace wishbone::testing
