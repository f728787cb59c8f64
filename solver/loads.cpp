#include "solver/loads.h"

namespace wishbone {
namespace {

/// Adds a wrench at a marker to its body: about Bo, and to the modes when the marker is a node's.
void add_wrench(const System& system, MarkerIndex i, const Vector3& t, const Vector3& f, Workspace& ws) {
  const Marker& marker = system.markers[i];
  if (marker.body < 0) return;
  BodyState& body = ws.bodies[marker.body];
  const Vector3 p_BM = ws.markers[i].p_WM - body.X_WB.p;
  body.F_applied.head<3>() += t + p_BM.cross(f);
  body.F_applied.tail<3>() += f;
  if (marker.node >= 0) {
    // Q = sum Psi_i^T f_i, body axes
    const int k = system.bodies[marker.body].flexible;
    const Vector3 f_B = body.X_WB.R.transpose() * f;
    ws.flexible[k].load.noalias() += system.flexible[k].modal.interface_shape(marker.node).transpose() * f_B;
  }
}

}  // namespace

ForceInput force_input(double t, const VectorX& x, int x_start, int state_count, int index,
                       const Workspace& ws) {
  return {t, ws.markers, {x.data() + x_start, static_cast<std::size_t>(state_count)}, ws.segments[index]};
}

void clear_loads(Workspace& ws) {
  for (BodyState& s : ws.bodies) s.F_applied.setZero();
  for (FlexibleState& f : ws.flexible) f.load.setZero();
}

void apply_forces(const System& system, double t, const VectorX& x, Workspace& ws) {
  ++ws.work.forces;
  clear_loads(ws);
  for (Wrench& w : ws.wrenches) w = Wrench{};

  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    const int n = element.state_count();
    ForceOutput out{ws.wrenches, {ws.x_rate.data() + x_start, static_cast<std::size_t>(n)}, 0.0};
    element.apply(force_input(t, x, x_start, n, index, ws), out);
    ws.element_powers[index] = out.power;
    x_start += n;
  });

  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const double mass = body.flexible < 0 ? body.mass : system.flexible[body.flexible].modal.mass();
    ws.bodies[i].F_applied.tail<3>() = mass * system.gravity;
  }
  for (std::size_t i = 0; i < system.markers.size(); ++i)
    add_wrench(system, static_cast<MarkerIndex>(i), ws.wrenches[i].t, ws.wrenches[i].f, ws);
}

void add_closure_loads(const System& system, const VectorX& lambda, Workspace& ws) {
  for (const Closure& closure : system.closures) {
    const auto l = lambda.segment(closure.row_start, closure.rows);
    const Vector6 F_A = ws.W_A.middleCols(closure.row_start, closure.rows) * l;
    const Vector6 F_B = ws.W_B.middleCols(closure.row_start, closure.rows) * l;
    add_wrench(system, closure.A, angular(F_A), linear(F_A), ws);
    add_wrench(system, closure.B, angular(F_B), linear(F_B), ws);
  }
}

}  // namespace wishbone
