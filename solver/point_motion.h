#pragma once

#include <optional>

#include "solver/evaluation.h"

namespace wishbone {

/// A point of a body: fixed to a rigid one, a node of a flexible one, or carried along by a frame of that.
struct BodyPoint {
  int body = -1;                   ///< index into System::bodies
  Vector3 p_BQ = Vector3::Zero();  ///< body axes, from the mass centre; undeformed on a flexible body [m]
  int node_id = 0;                 ///< of a flexible body; 0: none
  std::optional<FrameShapes> frame = std::nullopt;  ///< that carries the point of a flexible body
};

struct PointMotion {
  Vector3 p_WQ = Vector3::Zero();  ///< [m]
  Vector3 v_WQ = Vector3::Zero();  ///< [m/s]
  Vector3 a_WQ = Vector3::Zero();  ///< [m/s^2]
};

/// With b = p_BQ + delta and w, alpha of the body:
///     p = p_WB + b,   v = v_WB + w x b + delta',   a = a_WB + alpha x b + w x (w x b) + 2 w x delta' + delta''.
/// Needs the accelerations of an evaluation (calc_joint_forces). No marker is spent on the point, so that it costs nothing
/// but where it is asked for.
PointMotion calc_point_motion(const System& system, const BodyPoint& point, const Evaluation<double>& ev);

}  // namespace wishbone
