#include "solver/pose_transfer.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <variant>

#include "solver/kinematics.h"

namespace wishbone {
namespace {

constexpr int kMaxSteps = 50;
constexpr double kConverged = 1e-14;  // [m, rad]

/// The motion of the inboard joint frame F of a body whose parent is undeformed.
RigidMotion inboard_frame(const System& system, const TreeBody& body, const std::vector<RigidMotion>& motions,
                          const Workspace& ws) {
  if (body.parent < 0) return {body.X_PF, Vector6::Zero()};
  const RigidMotion& P = motions[body.parent];
  Pose X_PF = body.X_PF;
  if (body.parent_interface >= 0) {
    const ModalBodyState& modal = ws.flexible[system.bodies[body.parent].flexible].modal;
    const Vector3 p_PI = modal.interface_b.col(body.parent_interface);
    X_PF.p = body.on_frame ? Vector3(p_PI + X_PF.p) : p_PI;
  }
  RigidMotion F{P.X_WB * X_PF, P.V};
  F.V.tail<3>() += angular(P.V).cross(F.X_WB.p - P.X_WB.p);
  return F;
}

/// X_FM and V_FM = (w, v_Mo) in F that the body's motion wants.
RigidMotion motion_across(const TreeBody& body, const RigidMotion& F, const RigidMotion& B) {
  RigidMotion M{B.X_WB * body.X_MB.inverse(), B.V};
  M.V.tail<3>() += angular(B.V).cross(M.X_WB.p - B.X_WB.p);
  const Matrix3 R_FW = F.X_WB.R.transpose();
  const Vector3 w = angular(M.V) - angular(F.V);
  const Vector3 v = linear(M.V) - linear(F.V) - angular(F.V).cross(M.X_WB.p - F.X_WB.p);
  RigidMotion across{F.X_WB.inverse() * M.X_WB, Vector6::Zero()};
  across.V << R_FW * w, R_FW * v;
  return across;
}

/// (rotation vector, translation) from a pose to another, axes of F.
Vector6 pose_error(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(Matrix3(to.R * from.R.transpose()));
  Vector6 error;
  error << turn.angle() * turn.axis(), to.p - from.p;
  return error;
}

/// Speeds d with H d next to V.
VectorX nearest(const MatrixX& H, const Vector6& V) {
  return H.colPivHouseholderQr().solve(V);
}

template <class Joint>
void set_coordinates(const Joint& joint, double t, const RigidMotion& wanted, double* q, double* v) {
  constexpr int nv = Joint::kNv;
  if constexpr (nv > 0) {
    using Speeds = Eigen::Matrix<double, nv, 1>;
    for (int step = 0; step < kMaxSteps; ++step) {
      AcrossJoint<nv> across;
      joint.calc_across(t, q, across);
      const Speeds d = nearest(across.H, pose_error(across.X_FM, wanted.X_WB));
      if (!(d.norm() > kConverged)) break;
      joint.retract(d.data(), q);
    }
    AcrossJoint<nv> across;
    joint.calc_across(t, q, across);
    std::array<double, nv> rest{};
    Vector6 V_drift = Vector6::Zero(), A_drift = Vector6::Zero();
    if constexpr (Joint::kHasDrift) joint.calc_drift(t, q, rest.data(), V_drift, A_drift);
    Eigen::Map<Speeds>{v} = nearest(across.H, wanted.V - V_drift);
  }
}

}  // namespace

void set_rigid_motions(const System& system, const std::vector<RigidMotion>& motions, State& state,
                       Workspace& ws) {
  for (const FlexibleBody& f : system.flexible) {
    state.q.segment(f.z_start, f.modal.mode_count()).setZero();
    state.v.segment(f.z_rate_start, f.modal.mode_count()).setZero();
  }
  update_positions<double>(system, state.t, state.q, ws);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const RigidMotion wanted = motion_across(body, inboard_frame(system, body, motions, ws), motions[i]);
    std::visit(
        [&](const auto& joint) {
          set_coordinates(joint, state.t, wanted, state.q.data() + body.q_start,
                          state.v.data() + body.v_start);
        },
        body.joint);
  }
}

}  // namespace wishbone
