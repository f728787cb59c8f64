#include "solver/forward_dynamics.h"

#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/kinematics.h"
#include "solver/loads.h"

namespace wishbone {

void update_state(const System& system, const State& state, Workspace& ws) {
  update_positions(system, state.t, state.q, ws);
  update_velocities(system, state.t, state.v, ws);
  update_markers(system, ws);
  update_closures(system, ws);
  apply_forces(system, state.t, state.x, ws);
}

void calc_forward_dynamics(const System& system, const State& state, Workspace& ws) {
  update_state(system, state, ws);
  factor_inertia(system, ws);
  solve_accelerations(system, Terms::all, ws, ws.v_rate);
  if (ws.kept.empty()) return;
  // the open tree violates the closures by Phi'' = D v' - gamma; the multipliers undo that
  update_closure_accelerations(system, ws);
  factor_closures(system, ws);
  solve_multipliers(ws.Phi_dd, ws);
  add_closure_loads(system, ws.lambda, ws);
  solve_accelerations(system, Terms::all, ws, ws.v_rate);
}

void calc_joint_forces(const System& system, Workspace& ws) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    BodyState& s = ws.bodies[i];
    s.F_joint = s.P * s.A + s.Z;
  }
}

double calc_motion_power(const System& system, double t, const Workspace& ws) {
  double power = 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const auto* joint = std::get_if<PrescribedJoint>(&body.joint);
    if (joint == nullptr) continue;
    const BodyState& s = ws.bodies[i];
    AcrossJoint<0> across;
    joint->calc_across(t, nullptr, across);
    const Matrix3 R_WP = body.parent < 0 ? Matrix3::Identity() : ws.bodies[body.parent].X_WB.R;
    const Matrix3 R_WF = R_WP * body.X_PF.R;
    const Vector3 w = R_WF * across.V_drift.head<3>();
    const Vector3 v = R_WF * across.V_drift.tail<3>() + w.cross(s.p_MB);
    power += w.dot(angular(s.F_joint)) + v.dot(linear(s.F_joint));
  }
  return power;
}

}  // namespace wishbone
