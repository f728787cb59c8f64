#include "solver/point_motion.h"

namespace wishbone {
namespace {

/// Deflection of the point and its rates, world components.
struct Deflection {
  Vector3 delta = Vector3::Zero(), rate = Vector3::Zero(), acceleration = Vector3::Zero();
};

Deflection calc_deflection(const System& system, const BodyPoint& point, const Evaluation<double>& ev) {
  const int k = system.bodies[point.body].flexible;
  if (k < 0 || point.node_id == 0) return {};
  const ShapeSet& set = system.flexible[k].modal.set();
  const FlexibleMotionT<double>& flexible = ev.flexible[k];
  const Matrix3& R = ev.bodies[point.body].X_WB.R;
  const auto Psi = set.shapes.middleRows<3>(3 * set.node_index(point.node_id));
  return {R * (Psi * flexible.modal.z), R * (Psi * flexible.modal.zdot), R * (Psi * flexible.z_dd)};
}

}  // namespace

PointMotion calc_point_motion(const System& system, const BodyPoint& point, const Evaluation<double>& ev) {
  const BodyMotion& body = ev.bodies[point.body];
  const Deflection d = calc_deflection(system, point, ev);
  const Vector3 b = body.X_WB.R * point.p_BQ + d.delta;
  const Vector3 w = angular(body.V), alpha = angular(body.A);
  return {body.X_WB.p + b, linear(body.V) + w.cross(b) + d.rate,
          linear(body.A) + alpha.cross(b) + w.cross(w.cross(b)) + 2 * w.cross(d.rate) + d.acceleration};
}

}  // namespace wishbone
