#include "solver/kinematics.h"

#include <type_traits>
#include <variant>

namespace wishbone {
namespace {

const BodyState kInertialFrame{};

const BodyState& parent_state(const TreeBody& body, const Workspace& ws) {
  return body.parent < 0 ? kInertialFrame : ws.bodies[body.parent];
}

/// Position p_PFo of the inboard joint frame, parent axes.
Vector3 inboard_point(const System& system, const TreeBody& body, const Workspace& ws) {
  if (body.parent_node < 0) return body.X_PF.p;
  const int k = system.bodies[body.parent].flexible;
  return ws.flexible[k].modal.interface_b.col(body.parent_node);
}

/// Velocity R_WP delta' of the flexible node under the joint, world axes; zero on a rigid parent.
Vector3 node_deflection_rate(const System& system, const TreeBody& body, const Matrix3& R_WP,
                             const Workspace& ws) {
  if (body.parent_node < 0) return Vector3::Zero();
  const int k = system.bodies[body.parent].flexible;
  return R_WP * ws.flexible[k].modal.interface_delta_dot.col(body.parent_node);
}

template <class Joint>
void update_position(const System& system, const TreeBody& body, const Joint& joint, double t,
                     const double* q, BodyState& s, Workspace& ws) {
  constexpr int nv = Joint::kNv;
  const BodyState& parent = parent_state(body, ws);
  AcrossJoint<nv> across;
  joint.calc_across(t, q, across);

  const Matrix3 R_WF = parent.X_WB.R * body.X_PF.R;
  const Pose X_FB = across.X_FM * body.X_MB;
  s.X_WB.R = R_WF * X_FB.R;
  s.p_PB = parent.X_WB.R * inboard_point(system, body, ws) + R_WF * X_FB.p;
  s.X_WB.p = parent.X_WB.p + s.p_PB;

  // columns of H about Bo, world axes: (w, v_Mo + w x p_MB)
  s.p_MB = R_WF * (across.X_FM.R * body.X_MB.p);
  if constexpr (nv > 0)
    for (int i = 0; i < nv; ++i) {
      const Vector6 h = across.H.col(i);
      const Vector3 w = R_WF * angular(h);
      s.H.col(i) << w, R_WF * linear(h) + w.cross(s.p_MB);
    }
}

/// Motion that a prescribed joint has of itself, world axes, at Mo.
struct Drift {
  Vector6 V = Vector6::Zero(), A = Vector6::Zero();
};

Drift drift(const TreeBody& body, const PrescribedJoint& joint, double t, const Matrix3& R_WP) {
  AcrossJoint<0> across;
  joint.calc_across(t, nullptr, across);
  const Matrix3 R_WF = R_WP * body.X_PF.R;
  return {spatial(R_WF * across.V_drift.head<3>(), R_WF * across.V_drift.tail<3>()),
          spatial(R_WF * across.A_drift.head<3>(), R_WF * across.A_drift.tail<3>())};
}

template <class Joint>
void update_velocity(const System& system, const TreeBody& body, const Joint& joint, double t,
                     const double* v, BodyState& s, Workspace& ws) {
  constexpr int nv = Joint::kNv;
  const BodyState& parent = parent_state(body, ws);
  const Vector3 p_PM = s.p_PB - s.p_MB;

  // motion across the joint at Mo, from H v at Bo or from the prescribed motion; the node's velocity adds to the linear part
  Vector3 w_rel = Vector3::Zero(), v_rel = node_deflection_rate(system, body, parent.X_WB.R, ws);
  Vector3 alpha_drift = Vector3::Zero(), a_drift = Vector3::Zero();
  if constexpr (nv > 0) {
    const Vector6 Hv = s.H.leftCols<nv>() * Eigen::Map<const Eigen::Matrix<double, nv, 1>>(v);
    w_rel = angular(Hv);
    v_rel += linear(Hv) - w_rel.cross(s.p_MB);
  } else if constexpr (std::is_same_v<Joint, PrescribedJoint>) {
    const Drift d = drift(body, joint, t, parent.X_WB.R);
    w_rel = angular(d.V);
    v_rel += linear(d.V);
    alpha_drift = angular(d.A);
    a_drift = linear(d.A);
  }
  const Vector3 w_P = angular(parent.V);
  const Vector3 w_B = w_P + w_rel;
  const Vector3 v_M = linear(parent.V) + w_P.cross(p_PM) + v_rel;
  s.V << w_B, v_M + w_B.cross(s.p_MB);

  // alpha_B = alpha_P + w_P x w_rel + alpha_rel
  // a_Mo    = a_P + alpha_P x p_PM + w_P x (w_P x p_PM) + 2 w_P x v_rel + a_rel
  // a_Bo    = a_Mo + alpha_B x p_MB + w_B x (w_B x p_MB)
  const Vector3 c_alpha = w_P.cross(w_rel) + alpha_drift;
  const Vector3 c_M = w_P.cross(w_P.cross(p_PM)) + 2.0 * w_P.cross(v_rel) + a_drift;
  s.c << c_alpha, c_M + c_alpha.cross(s.p_MB) + w_B.cross(w_B.cross(s.p_MB));
}

}  // namespace

void update_positions(const System& system, double t, const VectorX& q, Workspace& ws) {
  ++ws.work.position;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    std::visit(
        [&](const auto& joint) {
          update_position(system, body, joint, t, q.data() + body.q_start, ws.bodies[i], ws);
        },
        body.joint);
    if (body.flexible >= 0) {
      const FlexibleBody& flexible = system.flexible[body.flexible];
      const int m = flexible.modal.mode_count();
      flexible.modal.set_position({q.data() + flexible.z_start, static_cast<std::size_t>(m)},
                                  ws.flexible[body.flexible].modal);
    }
  }
}

void update_velocities(const System& system, double t, const VectorX& v, Workspace& ws) {
  ++ws.work.velocity;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    BodyState& s = ws.bodies[i];
    std::visit(
        [&](const auto& joint) { update_velocity(system, body, joint, t, v.data() + body.v_start, s, ws); },
        body.joint);
    if (body.flexible >= 0) {
      const FlexibleBody& flexible = system.flexible[body.flexible];
      const std::size_t m = flexible.modal.mode_count();
      const Vector3 w_WB_B = s.X_WB.R.transpose() * angular(s.V);
      flexible.modal.set_velocity(w_WB_B, {v.data() + flexible.z_rate_start, m},
                                  ws.flexible[body.flexible].modal);
    }
  }
}

void update_markers(const System& system, Workspace& ws) {
  for (std::size_t i = 0; i < system.markers.size(); ++i) {
    const Marker& marker = system.markers[i];
    MarkerState& s = ws.markers[i];
    if (marker.body < 0) {
      s.R_WM = marker.X_BM.R;
      s.p_WM = marker.X_BM.p;
      continue;
    }
    const BodyState& body = ws.bodies[marker.body];
    s.R_WM = body.X_WB.R * marker.X_BM.R;
    s.w_WM = angular(body.V);
    Vector3 p_BM_B = marker.X_BM.p;
    Vector3 rate_B = Vector3::Zero();
    if (marker.node >= 0) {
      const ModalBodyState& modal = ws.flexible[system.bodies[marker.body].flexible].modal;
      p_BM_B = modal.interface_b.col(marker.node);
      rate_B = modal.interface_delta_dot.col(marker.node);
    }
    const Vector3 p_BM = body.X_WB.R * p_BM_B;
    s.p_WM = body.X_WB.p + p_BM;
    s.v_WM = Vector3(linear(body.V)) + s.w_WM.cross(p_BM) + body.X_WB.R * rate_B;
  }
}

void update_closure_marker_accelerations(const System& system, Workspace& ws) {
  const auto update = [&](MarkerIndex i) {
    const Marker& marker = system.markers[i];
    MarkerAcceleration& s = ws.marker_accelerations[i];
    if (marker.body < 0) return;
    const BodyState& body = ws.bodies[marker.body];
    const Vector3 w = angular(body.V);
    const Vector3 p_BM = ws.markers[i].p_WM - body.X_WB.p;
    s.alpha = angular(body.A);
    s.a = Vector3(linear(body.A)) + s.alpha.cross(p_BM) + w.cross(w.cross(p_BM));
    if (marker.node >= 0) {
      const int k = system.bodies[marker.body].flexible;
      const FlexibleState& flexible = ws.flexible[k];
      // + R (Psi z'' + 2 w x delta')
      s.a += body.X_WB.R * (system.flexible[k].modal.interface_shape(marker.node) * flexible.z_dd);
      s.a += 2.0 * w.cross(body.X_WB.R * flexible.modal.interface_delta_dot.col(marker.node));
    }
  };
  for (const Closure& closure : system.closures) {
    update(closure.A);
    update(closure.B);
  }
}

void calc_q_rate(const System& system, const VectorX& q, const VectorX& v, Eigen::Ref<VectorX> q_rate) {
  for (const TreeBody& body : system.bodies)
    std::visit(
        [&](const auto& joint) {
          joint.calc_q_rate(q.data() + body.q_start, v.data() + body.v_start, q_rate.data() + body.q_start);
        },
        body.joint);
  for (const FlexibleBody& flexible : system.flexible) {
    const int m = flexible.modal.mode_count();
    q_rate.segment(flexible.z_start, m) = v.segment(flexible.z_rate_start, m);
  }
}

void retract(const System& system, const VectorX& d, Eigen::Ref<VectorX> q) {
  for (const TreeBody& body : system.bodies)
    std::visit([&](const auto& joint) { joint.retract(d.data() + body.v_start, q.data() + body.q_start); },
               body.joint);
  for (const FlexibleBody& flexible : system.flexible) {
    const int m = flexible.modal.mode_count();
    q.segment(flexible.z_start, m) += d.segment(flexible.z_rate_start, m);
  }
}

void normalize_quaternions(const System& system, Eigen::Ref<VectorX> q) {
  for (const TreeBody& body : system.bodies)
    if (body.nq != body.nv) q.segment<4>(body.q_start).normalize();
}

}  // namespace wishbone
