#include "solver/inverse_dynamics.h"

#include "solver/forward_dynamics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

/// A_WB = shift(A_WP) + (0, R Psi z'' of the parent's node) + H v' + c.
void accelerate_bodies(const System& system, const VectorX& v_rate, Workspace& ws) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    BodyState& s = ws.bodies[i];
    s.A = s.c;
    s.A.noalias() += s.H.leftCols(body.nv) * v_rate.segment(body.v_start, body.nv);
    if (body.parent < 0) continue;
    const BodyState& parent = ws.bodies[body.parent];
    s.A += shift_velocity(parent.A, s.p_PB);
    if (body.parent_node >= 0) {
      const FlexibleBody& flexible = system.flexible[system.bodies[body.parent].flexible];
      const auto z_dd = v_rate.segment(flexible.z_rate_start, flexible.modal.mode_count());
      const Vector3 a_P = flexible.modal.interface_shape(body.parent_node) * z_dd;
      linear(s.A) += parent.X_WB.R * a_P;
    }
  }
}

/// Inertia force minus loads of one body, and its modal residual.
void set_own_force(const System& system, const TreeBody& body, const VectorX& v_rate, BodyState& s,
                   Workspace& ws, Eigen::Ref<VectorX> r) {
  s.F_joint = -s.F_applied;
  if (body.flexible < 0) {
    const Vector3 alpha_B = s.X_WB.R.transpose() * angular(s.A);
    const Vector3 w_B = s.X_WB.R.transpose() * angular(s.V);
    s.F_joint.head<3>() += s.X_WB.R * (body.J_B * alpha_B + w_B.cross(body.J_B * w_B));
    s.F_joint.tail<3>() += body.mass * linear(s.A);
    return;
  }
  const FlexibleBody& flexible = system.flexible[body.flexible];
  const FlexibleState& f = ws.flexible[body.flexible];
  const auto z_dd = v_rate.segment(flexible.z_rate_start, flexible.modal.mode_count());
  const Vector3 alpha_B = s.X_WB.R.transpose() * angular(s.A);
  // J alpha + S z'' + t_bias = N,   S^T alpha + z'' + h_bias = Q
  s.F_joint.head<3>() += s.X_WB.R * (f.modal.J * alpha_B + f.modal.S * z_dd + f.modal.t_bias);
  s.F_joint.tail<3>() += flexible.modal.mass() * linear(s.A);
  auto r_z = r.segment(flexible.z_rate_start, z_dd.size());
  r_z = z_dd + f.modal.h_bias - f.load;
  r_z.noalias() += f.modal.S.transpose() * alpha_B;
}

/// r = H^T F joint by joint, tips first, the rest handed to the parent.
void project_onto_hinges(const System& system, Workspace& ws, Eigen::Ref<VectorX> r) {
  for (int i = static_cast<int>(system.bodies.size()) - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    const BodyState& s = ws.bodies[i];
    r.segment(body.v_start, body.nv) = s.H.leftCols(body.nv).transpose() * s.F_joint;
    if (body.parent < 0) continue;
    BodyState& parent = ws.bodies[body.parent];
    parent.F_joint += shift_wrench(s.F_joint, s.p_PB);
    if (body.parent_node >= 0) {
      const FlexibleBody& flexible = system.flexible[system.bodies[body.parent].flexible];
      const Vector3 f_P = parent.X_WB.R.transpose() * linear(s.F_joint);
      r.segment(flexible.z_rate_start, flexible.modal.mode_count()).noalias() +=
          flexible.modal.interface_shape(body.parent_node).transpose() * f_P;
    }
  }
}

}  // namespace

void calc_motion_residual(const System& system, const State& state, const VectorX& v_rate,
                          const VectorX& lambda, Workspace& ws, Eigen::Ref<VectorX> r) {
  ++ws.work.inverse_dynamics;
  update_state(system, state, ws);
  add_closure_loads(system, lambda, ws);
  accelerate_bodies(system, v_rate, ws);
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    set_own_force(system, system.bodies[i], v_rate, ws.bodies[i], ws, r);
  project_onto_hinges(system, ws, r);
}

void calc_closure_force(const System& system, const VectorX& mu, Workspace& ws, Eigen::Ref<VectorX> force) {
  clear_loads(ws);
  add_closure_loads(system, mu, ws);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    ws.bodies[i].F_joint = ws.bodies[i].F_applied;
    if (body.flexible < 0) continue;
    const FlexibleBody& flexible = system.flexible[body.flexible];
    force.segment(flexible.z_rate_start, flexible.modal.mode_count()) = ws.flexible[body.flexible].load;
  }
  project_onto_hinges(system, ws, force);
}

}  // namespace wishbone
