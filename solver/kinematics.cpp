#include "solver/kinematics.h"

#include <algorithm>
#include <variant>

#include "core/dual.h"
#include "solver/interface.h"

namespace wishbone {
namespace {

template <class T>
const BodyMotionT<T> kInertialFrame{};

template <class T>
const BodyMotionT<T>& parent_motion(const TreeBody& body, const Evaluation<T>& ev) {
  return body.parent < 0 ? kInertialFrame<T> : ev.bodies[body.parent];
}

// What interfaces of flexible parents take is kept out of line: joints on rigid bodies are the rule.

/// p_PF of a joint on an interface, world axes.
template <class T>
[[gnu::noinline]] Vector3T<T> point_on_interface(const System& system, const TreeBody& body,
                                                 const Evaluation<T>& ev) {
  const Interface<T> interface = parent_interface(system, body, ev);
  if (!body.on_frame) return interface.p_PI();
  return interface.p_PI() + interface.R_WI() * body.X_PF.p;
}

/// Velocity against the parent of the interface under the joint, world axes.
template <class T>
[[gnu::noinline]] Vector3T<T> velocity_of_interface(const System& system, const TreeBody& body,
                                                    const Evaluation<T>& ev) {
  return parent_interface(system, body, ev).v_PI();
}

/// Columns of H about Bo, world axes: (w, v_Mo + w x p_MB).
template <class Joint, class T>
void set_hinge_columns(const Matrix3T<T>& R_WF, const Eigen::Matrix<T, 6, Joint::kNv>& H_F,
                       const Vector3T<T>& p_MB, Vector6T<T>* H) {
  if constexpr (Joint::kNv > 0)
    for (int i = 0; i < Joint::kNv; ++i) {
      Vector3T<T> w = Vector3T<T>::Zero(), v_B = Vector3T<T>::Zero();
      if constexpr (Joint::kRotates) {
        w = R_WF * H_F.template block<3, 1>(0, i);
        v_B = w.cross(p_MB);
      }
      if constexpr (Joint::kTranslates) v_B += R_WF * H_F.template block<3, 1>(3, i);
      H[i] << w, v_B;
    }
}

template <class Joint, class T>
void update_position(const System& system, const TreeBody& body, const Joint& joint, double t, const T* q,
                     Evaluation<T>& ev, BodyMotionT<T>& s) {
  constexpr int nv = Joint::kNv;
  const BodyMotionT<T>& parent = parent_motion(body, ev);
  AcrossJoint<nv, T> across;
  joint.calc_across(t, q, across);

  const Matrix3T<T> R_WF = inboard_axes(system, body, ev);
  Matrix3T<T> R_WM = R_WF;
  if constexpr (Joint::kRotates) R_WM = R_WF * across.X_FM.R;
  if (body.turned_MB)
    s.X_WB.R = R_WM * body.X_MB.R;
  else
    s.X_WB.R = R_WM;
  s.p_MB = R_WM * body.X_MB.p;
  // p_PB = p_PF + p_FM + p_MB
  s.p_PB = s.p_MB;
  if constexpr (Joint::kTranslates) s.p_PB += R_WF * across.X_FM.p;
  if (body.parent_interface < 0)
    s.p_PB += parent.X_WB.R * body.X_PF.p;
  else
    s.p_PB += point_on_interface(system, body, ev);
  s.X_WB.p = parent.X_WB.p + s.p_PB;

  set_hinge_columns<Joint, T>(R_WF, across.H, s.p_MB, ev.H.data() + body.v_start);
}

/// What the turning of the interface frame under the joint adds to V and c, which are those of a frame that keeps the axes
/// of the parent: the joint's motion (w_rel, v_rel of Bo) is seen from the frame.
template <class T>
[[gnu::noinline]] void add_turning_of_frame(const System& system, const TreeBody& body,
                                            const Evaluation<T>& ev, const Vector3T<T>& w_P,
                                            const Vector3T<T>& w_rel, const Vector3T<T>& v_rel,
                                            BodyMotionT<T>& s) {
  const Interface<T> frame = parent_interface(system, body, ev);
  const Vector3T<T> w_PI = frame.w_PI(), p_IB = s.p_PB - frame.p_PI();
  const Vector3T<T> alpha = frame.alpha_bias(w_P), alpha_IB = w_PI.cross(w_rel);
  const Vector3T<T> a = acceleration_by_turning(w_P, w_PI, alpha, p_IB, v_rel);
  s.V += spatial(w_PI, w_PI.cross(p_IB));
  s.c += spatial(Vector3T<T>(alpha + alpha_IB), a);
}

template <class Joint, class T>
void update_velocity(const System& system, const TreeBody& body, const Joint& joint, double t, const T* q,
                     const T* v, const Evaluation<T>& ev, BodyMotionT<T>& s) {
  const BodyMotionT<T>& parent = parent_motion(body, ev);

  // motion of Bo as seen from the parent: H v, the drift of prescribed motions and turning axes, and the interface's velocity
  Vector3T<T> w_rel = Vector3T<T>::Zero(), v_PI = Vector3T<T>::Zero();
  if (body.parent_interface >= 0) v_PI = velocity_of_interface(system, body, ev);
  Vector3T<T> v_rel = v_PI;
  for (int i = 0; i < Joint::kNv; ++i) {
    const Vector6T<T>& h = ev.H[body.v_start + i];
    w_rel += angular(h) * v[i];
    v_rel += linear(h) * v[i];
  }
  Vector3T<T> alpha_drift, a_drift;
  if constexpr (Joint::kHasDrift) {
    Vector6T<T> V_drift, A_drift;
    joint.calc_drift(t, q, v, V_drift, A_drift);
    const Matrix3T<T> R_WF = inboard_axes(system, body, ev);
    const Vector3T<T> w_drift = R_WF * angular(V_drift);
    w_rel += w_drift;
    v_rel += R_WF * linear(V_drift) + w_drift.cross(s.p_MB);
    alpha_drift = R_WF * angular(A_drift);
    a_drift = R_WF * linear(A_drift) + alpha_drift.cross(s.p_MB);
  }
  const Vector3T<T> w_P = angular(parent.V);
  const Vector3T<T> w_P_x_p = w_P.cross(s.p_PB);
  s.V << w_P + w_rel, linear(parent.V) + w_P_x_p + v_rel;

  // alpha_B = alpha_P + w_P x w_rel + alpha_rel
  // a_Bo    = a_P + alpha_P x p_PB + w_P x (w_P x p_PB + 2 v_rel) + w_rel x (w_rel x p_MB) + a_rel
  const Vector3T<T> turning = w_P_x_p + 2.0 * v_rel;
  const Vector3T<T> w_rel_x_p = w_rel.cross(s.p_MB);
  s.c << w_P.cross(w_rel), w_P.cross(turning) + w_rel.cross(w_rel_x_p);
  if constexpr (Joint::kHasDrift) {
    s.c.template head<3>() += alpha_drift;
    s.c.template tail<3>() += a_drift;
  }
  if (body.on_frame) add_turning_of_frame<T>(system, body, ev, w_P, w_rel, v_rel - v_PI, s);
}

// Of doubles with everything inlined (flatten): this runs in every evaluation, and left to itself the compiler makes half of
// the operations on 3-vectors calls. Of Duals the calls cost little, and the code would be large.

template <class Joint>
[[gnu::flatten]] void update_position(const System& system, const TreeBody& body, const Joint& joint,
                                      double t, const double* q, Evaluation<double>& ev, BodyMotion& s) {
  update_position<Joint, double>(system, body, joint, t, q, ev, s);
}

template <class Joint>
[[gnu::flatten]] void update_velocity(const System& system, const TreeBody& body, const Joint& joint,
                                      double t, const double* q, const double* v,
                                      const Evaluation<double>& ev, BodyMotion& s) {
  update_velocity<Joint, double>(system, body, joint, t, q, v, ev, s);
}

}  // namespace

template <class T>
void update_positions(const System& system, double t, const VectorXT<T>& q, Evaluation<T>& ev) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    std::visit(
        [&](const auto& joint) {
          update_position(system, body, joint, t, q.data() + body.q_start, ev, ev.bodies[i]);
        },
        body.joint);
    if (body.flexible >= 0) {
      const FlexibleBody& flexible = system.flexible[body.flexible];
      flexible.modal.set_position(q.data() + flexible.z_start, ev.flexible[body.flexible].modal);
    }
  }
}

template <class T>
void update_velocities(const System& system, double t, const VectorXT<T>& q, const VectorXT<T>& v,
                       Evaluation<T>& ev) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    BodyMotionT<T>& s = ev.bodies[i];
    std::visit(
        [&](const auto& joint) {
          update_velocity(system, body, joint, t, q.data() + body.q_start, v.data() + body.v_start, ev, s);
        },
        body.joint);
    if (body.flexible >= 0) {
      const FlexibleBody& flexible = system.flexible[body.flexible];
      const Vector3T<T> w_WB_B = s.X_WB.R.transpose() * angular(s.V);
      flexible.modal.set_velocity(w_WB_B, v.data() + flexible.z_rate_start, ev.flexible[body.flexible].modal);
    }
  }
}

template <class T>
void update_markers(const System& system, Evaluation<T>& ev) {
  for (std::size_t i = 0; i < system.markers.size(); ++i) {
    const Marker& marker = system.markers[i];
    MarkerStateT<T>& s = ev.markers[i];
    if (marker.body < 0) {
      s.R_WM = marker.X_BM.R.cast<T>();
      s.p_WM = marker.X_BM.p.cast<T>();
      continue;
    }
    const BodyMotionT<T>& body = ev.bodies[marker.body];
    s.w_WM = angular(body.V);
    s.v_WM = linear(body.V);
    Vector3T<T> p_BM;
    if (marker.interface < 0) {
      s.R_WM = body.X_WB.R * marker.X_BM.R;
      p_BM = body.X_WB.R * marker.X_BM.p;
    } else {
      const Interface<T> interface(system, marker.body, marker.interface, ev);
      p_BM = interface.p_PI();
      s.v_WM += interface.v_PI();
      if (marker.on_frame) {
        const Matrix3T<T> R_WI = interface.R_WI();
        const Vector3T<T> p_IM = R_WI * marker.X_BM.p, w_BI = interface.w_PI();
        s.R_WM = R_WI * marker.X_BM.R;
        p_BM += p_IM;
        s.w_WM += w_BI;
        s.v_WM += w_BI.cross(p_IM);
      } else {
        s.R_WM = body.X_WB.R * marker.X_BM.R;
      }
    }
    s.p_WM = body.X_WB.p + p_BM;
    s.v_WM += angular(body.V).cross(p_BM);
  }
}

template <class T>
void update_closure_marker_accelerations(const System& system, Evaluation<T>& ev) {
  const auto update = [&](MarkerIndex i) {
    const Marker& marker = system.markers[i];
    if (marker.body < 0) return;
    MarkerAccelerationT<T>& s = ev.marker_accelerations[i];
    const BodyMotionT<T>& body = ev.bodies[marker.body];
    const Vector3T<T> w = angular(body.V);
    const Vector3T<T> p_BM = ev.markers[i].p_WM - body.X_WB.p;
    s.alpha = angular(body.A);
    s.a = linear(body.A) + s.alpha.cross(p_BM) + w.cross(w.cross(p_BM));
    if (marker.interface < 0) return;
    // + R Psi z'' + 2 w x R delta', and what turning adds
    const VectorXT<T>& z_dd = ev.flexible[system.bodies[marker.body].flexible].z_dd;
    const Interface<T> interface(system, marker.body, marker.interface, ev);
    s.a += interface.v_Theta(z_dd) + 2.0 * w.cross(interface.v_PI());
    if (!marker.on_frame) return;
    const Vector3T<T> alpha = interface.w_Theta(z_dd) + interface.alpha_bias(w);
    s.alpha += alpha;
    s.a +=
        acceleration_by_turning<T>(w, interface.w_PI(), alpha, p_BM - interface.p_PI(), Vector3T<T>::Zero());
  };
  for (const Closure& closure : system.closures)
    for (const MarkerIndex marker : closure.markers) update(marker);
}

template <class T>
void calc_q_rate(const System& system, const VectorXT<T>& q, const VectorXT<T>& v, T* q_rate) {
  for (const TreeBody& body : system.bodies)
    std::visit(
        [&](const auto& joint) {
          joint.calc_q_rate(q.data() + body.q_start, v.data() + body.v_start, q_rate + body.q_start);
        },
        body.joint);
  for (const FlexibleBody& flexible : system.flexible)
    std::copy_n(v.data() + flexible.z_rate_start, flexible.modal.mode_count(), q_rate + flexible.z_start);
}

#define WISHBONE_INSTANTIATE(T)                                                                  \
  template void update_positions(const System&, double, const VectorXT<T>&, Evaluation<T>&);     \
  template void update_velocities(const System&, double, const VectorXT<T>&, const VectorXT<T>&, \
                                  Evaluation<T>&);                                               \
  template void update_markers(const System&, Evaluation<T>&);                                   \
  template void update_closure_marker_accelerations(const System&, Evaluation<T>&);              \
  template void calc_q_rate(const System&, const VectorXT<T>&, const VectorXT<T>&, T*);
WISHBONE_INSTANTIATE(double)
WISHBONE_INSTANTIATE(Dual)
#undef WISHBONE_INSTANTIATE

void retract(const System& system, const VectorX& d, Eigen::Ref<VectorX> q) {
  for (const TreeBody& body : system.bodies)
    std::visit([&](const auto& joint) { joint.retract(d.data() + body.v_start, q.data() + body.q_start); },
               body.joint);
  for (const FlexibleBody& flexible : system.flexible) {
    const int m = flexible.modal.mode_count();
    q.segment(flexible.z_start, m) += d.segment(flexible.z_rate_start, m);
  }
}

void calc_displacement(const System& system, const VectorX& q0, const VectorX& q, Eigen::Ref<VectorX> d) {
  for (const TreeBody& body : system.bodies)
    std::visit(
        [&](const auto& joint) {
          joint.calc_displacement(q0.data() + body.q_start, q.data() + body.q_start, d.data() + body.v_start);
        },
        body.joint);
  for (const FlexibleBody& flexible : system.flexible) {
    const int m = flexible.modal.mode_count();
    d.segment(flexible.z_rate_start, m) = q.segment(flexible.z_start, m) - q0.segment(flexible.z_start, m);
  }
}

void normalize_quaternions(const System& system, Eigen::Ref<VectorX> q) {
  for (const TreeBody& body : system.bodies)
    if (body.nq != body.nv) q.segment<4>(body.q_start).normalize();
}

}  // namespace wishbone
