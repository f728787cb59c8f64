#pragma once

#include "solver/system.h"

/// What the parts of the observer share.
namespace wishbone::observation {

inline constexpr const char* kWorld = "world";

inline void put(const Vector3& a, double* out) {
  Eigen::Map<Vector3>{out} = a;
}

struct JointMotion {
  double position = 0, rate = 0;
};

/// Coordinate and speed of a joint with one freedom or with a prescribed motion.
inline JointMotion scalar_motion(const TreeBody& body, const State& state) {
  if (const auto* prescribed = std::get_if<PrescribedJoint>(&body.joint)) {
    const MotionValue u = prescribed->motion.at(state.t);
    return {u.position, u.rate};
  }
  return {state.q[body.q_start], state.v[body.v_start]};
}

}  // namespace wishbone::observation
