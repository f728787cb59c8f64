#include "solver/point_motion.h"

namespace wishbone {
namespace {

/// Deflection of the point and its rates as seen from the body.
struct Deflection {
  Vector3 delta = Vector3::Zero(), rate = Vector3::Zero(), acceleration = Vector3::Zero();
};

/// delta = Psi z of a node.
Deflection node_deflection(int node_id, const ShapeSet& set, const FlexibleMotionT<double>& flexible) {
  const auto Psi = set.shapes.middleRows<3>(3 * set.node_index(node_id));
  return {Psi * flexible.modal.z, Psi * flexible.modal.zdot, Psi * flexible.z_dd};
}

/// delta = u + (R_BI - 1) r of a point at r from the origin of the undeformed frame I.
Deflection carried_deflection(const FrameShapes& frame, const Vector3& r,
                              const FlexibleMotionT<double>& flexible) {
  FrameTurn turn;
  turn.set_position(frame.rotation * flexible.modal.z);
  turn.set_velocity(frame.rotation * flexible.modal.zdot);
  const Vector3 b = turn.R_BI * r, w = turn.w_BI;
  const Vector3 alpha = turn.J * (frame.rotation * flexible.z_dd) + turn.alpha_bias;
  return {frame.translation * flexible.modal.z + b - r, frame.translation * flexible.modal.zdot + w.cross(b),
          frame.translation * flexible.z_dd + alpha.cross(b) + w.cross(w.cross(b))};
}

Deflection calc_deflection(const System& system, const BodyPoint& point, const Evaluation<double>& ev) {
  const int k = system.bodies[point.body].flexible;
  if (k < 0) return {};
  if (point.frame) return carried_deflection(*point.frame, point.p_BQ - point.frame->origin, ev.flexible[k]);
  if (point.node_id == 0) return {};
  return node_deflection(point.node_id, system.flexible[k].modal.set(), ev.flexible[k]);
}

}  // namespace

PointMotion calc_point_motion(const System& system, const BodyPoint& point, const Evaluation<double>& ev) {
  const BodyMotion& body = ev.bodies[point.body];
  const Deflection d = calc_deflection(system, point, ev);
  const Matrix3& R = body.X_WB.R;
  const Vector3 b = R * (point.p_BQ + d.delta), rate = R * d.rate;
  const Vector3 w = angular(body.V), alpha = angular(body.A);
  return {body.X_WB.p + b, linear(body.V) + w.cross(b) + rate,
          linear(body.A) + alpha.cross(b) + w.cross(w.cross(b)) + 2 * w.cross(rate) + R * d.acceleration};
}

}  // namespace wishbone
