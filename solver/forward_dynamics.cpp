#include "solver/forward_dynamics.h"

#include "core/dual.h"
#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closures.h"
#include "solver/interface.h"
#include "solver/inverse_dynamics.h"
#include "solver/loads.h"

namespace wishbone {

void update_state(const System& system, const State& state, Workspace& ws) {
  ++ws.work.position;
  ++ws.work.velocity;
  count_forces(system, ws.work);
  update_state<double>(system, state.t, state.q, state.v, state.x, ws);
}

void calc_forward_dynamics(const System& system, const State& state, Workspace& ws) {
  update_state(system, state, ws);
  factor_inertia(system, ws);
  calc_bias(system, Terms::all, ws);
  calc_accelerations(system, Terms::all, ws, ws.v_rate);
  if (ws.closure.kept.empty()) return;
  // the open tree violates the closures by Phi'' = D v' - gamma; the multipliers undo that
  update_closure_accelerations<double>(system, state.t, ws);
  factor_closures(system, kDynamicsRankTolerance, ws);
  solve_multipliers(ws.Phi_dd, ws);
  ws.e.noalias() += ws.closure.U * ws.closure.solution;
  calc_accelerations(system, Terms::all, ws, ws.v_rate);
}

void calc_joint_forces(const System& system, Workspace& ws) {
  calc_motion_residual<double>(system, ws.v_rate, ws.lambda, ws, ws.hinge_force.data());
}

template <class T>
T calc_motion_power(const System& system, double t, const Evaluation<T>& ev) {
  T power(0);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const auto* joint = std::get_if<PrescribedJoint>(&body.joint);
    if (joint == nullptr) continue;
    const BodyMotionT<T>& s = ev.bodies[i];
    Vector6T<T> V_drift, A_drift;
    joint->calc_drift(t, static_cast<const T*>(nullptr), static_cast<const T*>(nullptr), V_drift, A_drift);
    const Matrix3T<T> R_WF = inboard_axes(system, body, ev);
    const Vector3T<T> w = R_WF * angular(V_drift);
    const Vector3T<T> v = R_WF * linear(V_drift) + w.cross(s.p_MB);
    power += w.dot(angular(s.F_joint)) + v.dot(linear(s.F_joint));
  }
  return power;
}

template double calc_motion_power(const System&, double, const Evaluation<double>&);
template Dual calc_motion_power(const System&, double, const Evaluation<Dual>&);

}  // namespace wishbone
