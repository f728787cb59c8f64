#include "solver/inverse_dynamics.h"

#include "core/dual.h"
#include "solver/closures.h"
#include "solver/interface.h"
#include "solver/kinematics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

/// A_WB = shift(A_WP) + shift(Theta z'') of the parent's interface + H v' + c.
template <class T>
void accelerate_bodies(const System& system, const VectorXT<T>& v_rate, Evaluation<T>& ev) {
  for (std::size_t k = 0; k < system.flexible.size(); ++k) {
    const FlexibleBody& flexible = system.flexible[k];
    ev.flexible[k].z_dd = v_rate.segment(flexible.z_rate_start, flexible.modal.mode_count());
  }
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    BodyMotionT<T>& s = ev.bodies[i];
    s.A = s.c;
    for (int j = 0; j < body.nv; ++j) s.A += ev.H[body.v_start + j] * v_rate[body.v_start + j];
    if (body.parent < 0) continue;
    const BodyMotionT<T>& parent = ev.bodies[body.parent];
    s.A += shift_velocity(parent.A, s.p_PB);
    if (body.parent_interface < 0) continue;
    const VectorXT<T>& z_dd = ev.flexible[system.bodies[body.parent].flexible].z_dd;
    s.A += parent_interface(system, body, ev).acceleration(z_dd, s.p_PB);
  }
}

/// Inertia force minus loads of one body, and its modal residual.
template <class T>
void set_own_force(const System& system, const TreeBody& body, BodyMotionT<T>& s, const Evaluation<T>& ev,
                   T* r) {
  s.F_joint = -s.F_applied;
  const Vector3T<T> alpha_B = s.X_WB.R.transpose() * angular(s.A);
  if (body.flexible < 0) {
    const Vector3T<T> w_B = s.X_WB.R.transpose() * angular(s.V);
    const Vector3T<T> Jw = body.J_B * w_B, J_alpha = body.J_B * alpha_B;
    s.F_joint.template head<3>() += s.X_WB.R * (J_alpha + w_B.cross(Jw));
    s.F_joint.template tail<3>() += body.mass * linear(s.A);
    return;
  }
  const FlexibleBody& flexible = system.flexible[body.flexible];
  const FlexibleMotionT<T>& f = ev.flexible[body.flexible];
  // J alpha + S z'' + t_bias = N,   m a + f_bias = F,   S^T alpha + z'' + h_bias = Q
  const Vector3T<T> Sz = f.modal.S * f.z_dd;
  s.F_joint.template head<3>() += s.X_WB.R * (f.modal.J * alpha_B + Sz + f.modal.t_bias);
  s.F_joint.template tail<3>() += flexible.modal.mass() * linear(s.A);
  Eigen::Map<VectorXT<T>> r_z(r + flexible.z_rate_start, f.z_dd.size());
  r_z = f.z_dd + f.modal.h_bias - f.load;
  r_z += f.modal.S.transpose().lazyProduct(alpha_B);
  if (flexible.modal.mean_axes()) return;
  // c x a in N, alpha x c + P z'' + f_bias in F, P^T a in Q
  const Matrix3X& P = flexible.modal.momentum_shape();
  const Vector3T<T> a_B = s.X_WB.R.transpose() * linear(s.A);
  const Vector3T<T> Pz = P * f.z_dd;
  s.F_joint.template head<3>() += s.X_WB.R * f.modal.c.cross(a_B);
  s.F_joint.template tail<3>() += s.X_WB.R * (alpha_B.cross(f.modal.c) + Pz + f.modal.f_bias);
  r_z += P.transpose().lazyProduct(a_B);
}

/// r = H^T F joint by joint, tips first, the rest handed to the parent.
template <class T>
void project_onto_hinges(const System& system, Evaluation<T>& ev, T* r) {
  for (int i = static_cast<int>(system.bodies.size()) - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotionT<T>& s = ev.bodies[i];
    for (int j = 0; j < body.nv; ++j) r[body.v_start + j] = ev.H[body.v_start + j].dot(s.F_joint);
    if (body.parent < 0) continue;
    BodyMotionT<T>& parent = ev.bodies[body.parent];
    parent.F_joint += shift_wrench(s.F_joint, s.p_PB);
    if (body.parent_interface < 0) continue;
    const FlexibleBody& flexible = system.flexible[system.bodies[body.parent].flexible];
    parent_interface(system, body, ev)
        .add_load(angular(s.F_joint), linear(s.F_joint), s.p_PB,
                  Eigen::Map<VectorXT<T>>(r + flexible.z_rate_start, flexible.modal.mode_count()));
  }
}

}  // namespace

template <class T>
void update_state(const System& system, double t, const VectorXT<T>& q, const VectorXT<T>& v,
                  const VectorXT<T>& x, Evaluation<T>& ev) {
  update_positions(system, t, q, ev);
  update_velocities(system, t, q, v, ev);
  update_markers(system, ev);
  update_closures(system, t, ev);
  apply_forces(system, t, x, ev);
}

template <class T>
void calc_motion_residual(const System& system, const VectorXT<T>& v_rate, const VectorXT<T>& lambda,
                          Evaluation<T>& ev, T* r) {
  add_closure_loads(system, lambda, ev);
  accelerate_bodies(system, v_rate, ev);
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    set_own_force(system, system.bodies[i], ev.bodies[i], ev, r);
  project_onto_hinges(system, ev, r);
}

template <class T>
void calc_closure_force(const System& system, const VectorXT<T>& mu, Evaluation<T>& ev, T* force) {
  clear_loads(ev);
  add_closure_loads(system, mu, ev);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    ev.bodies[i].F_joint = ev.bodies[i].F_applied;
    if (body.flexible < 0) continue;
    const FlexibleBody& flexible = system.flexible[body.flexible];
    Eigen::Map<VectorXT<T>>(force + flexible.z_rate_start, flexible.modal.mode_count()) =
        ev.flexible[body.flexible].load;
  }
  project_onto_hinges(system, ev, force);
}

#define WISHBONE_INSTANTIATE(T)                                                                             \
  template void update_state(const System&, double, const VectorXT<T>&, const VectorXT<T>&,                 \
                             const VectorXT<T>&, Evaluation<T>&);                                           \
  template void calc_motion_residual(const System&, const VectorXT<T>&, const VectorXT<T>&, Evaluation<T>&, \
                                     T*);                                                                   \
  template void calc_closure_force(const System&, const VectorXT<T>&, Evaluation<T>&, T*);
WISHBONE_INSTANTIATE(double)
WISHBONE_INSTANTIATE(Dual)
#undef WISHBONE_INSTANTIATE

}  // namespace wishbone
