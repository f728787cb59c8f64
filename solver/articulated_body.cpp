#include "solver/articulated_body.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "core/error.h"
#include "solver/interface.h"

namespace wishbone {
namespace {

/// Least pivots of D = H^T P H, as a share of the inertia that would move with the joint if nothing cancelled. A mass on
/// the axis of its joint has no lever, but for the rounding of its place, which counts squared; with more freedoms the
/// lever cancels in the factorisation, and its rounding counts.
constexpr double kLeastLever = 1e-12;
constexpr double kLeastPivot = 1e-14;

[[noreturn]] void fail_singular(const TreeBody& body, double pivot) {
  throw NumericsError({"body '" + body.name + "', joint '" + body.joint_name + "'",
                       "the inertia that moves with the joint is not positive definite",
                       fmt::format("pivot {:g}", pivot),
                       "give the body, or what hangs on it, mass and inertia about the joint's axes"});
}

void set_own_inertia(const TreeBody& body, const BodyMotion& s, ArticulatedBody& a) {
  a.J = rotate_inertia(s.X_WB.R, body.J_B);
  a.P.setZero();
  a.P.topLeftCorner<3, 3>() = a.J;
  a.P.bottomRightCorner<3, 3>().diagonal().setConstant(body.mass);
}

/// sum += factor matrix, with a matrix or its diagonal.
void add_scaled(const MatrixX& matrix, double factor, MatrixX& sum) {
  if (matrix.cols() == 1)
    sum.diagonal() += factor * matrix.col(0);
  else
    sum += factor * matrix;
}

/// M_zz = 1 + h C + h^2 K
void set_modal_mass(const FlexibleBody& flexible, double h, CondensedModes& f) {
  const ShapeSet& set = flexible.modal.set();
  if (flexible.carries_joints || (h > 0 && !set.uncoupled())) {
    f.mass = CondensedModes::Mass::full;
    f.M_zz.setIdentity();
    if (h == 0) return;
    add_scaled(set.damping, h, f.M_zz);
    add_scaled(set.stiffness, h * h, f.M_zz);
  } else if (h > 0) {
    f.mass = CondensedModes::Mass::diagonal;
    f.diagonal = VectorX::Ones(f.diagonal.size()) + h * set.damping.col(0) + h * h * set.stiffness.col(0);
  } else {
    f.mass = CondensedModes::Mass::unit;
  }
}

/// Instantaneous inertia J(z), couplings S(z), c(z) and P (zero with mean axes); children's shares are added before they come
/// by.
void set_own_inertia(const FlexibleBody& flexible, const BodyMotion& s, const ModalBodyState& modal,
                     ArticulatedBody& a, CondensedModes& f) {
  a.P.setZero();
  a.P.topLeftCorner<3, 3>() = rotate_inertia(s.X_WB.R, modal.J);
  a.P.bottomRightCorner<3, 3>().diagonal().setConstant(flexible.modal.mass());
  f.Y.leftCols<3>().noalias() = modal.S.transpose() * s.X_WB.R.transpose();
  if (flexible.modal.mean_axes()) {
    f.Y.rightCols<3>().setZero();
  } else {
    const Matrix3 c_skew = skew(Vector3(s.X_WB.R * modal.c));
    a.P.topRightCorner<3, 3>() = c_skew;
    a.P.bottomLeftCorner<3, 3>() = c_skew.transpose();
    f.Y.rightCols<3>().noalias() = flexible.modal.momentum_shape().transpose() * s.X_WB.R.transpose();
  }
}

/// P = M_rr - Y^T Y with Y = L_z^-1 M_zr.
void condense_modes(const FlexibleBody& flexible, Matrix6& P, CondensedModes& f) {
  if (f.mass == CondensedModes::Mass::full) Eigen::LLT<Eigen::Ref<MatrixX>> factor(f.M_zz);  // in place
  if (f.mass == CondensedModes::Mass::diagonal) f.diagonal = f.diagonal.cwiseSqrt();
  f.solve(f.Y);
  if (flexible.carries_joints || !flexible.modal.mean_axes()) {
    P.noalias() -= f.Y.transpose() * f.Y;
  } else {
    const Matrix3 SS = f.Y.leftCols<3>().transpose() * f.Y.leftCols<3>();
    P.topLeftCorner<3, 3>() -= SS;
  }
}

/// Adds a child's inertia P+ (about the child's origin) to a flexible parent through the node that carries it:
/// A_child = shift(A_parent) + (0, R Psi z'').
void add_through_node(const Matrix6& P_plus, const BodyMotion& child, const Matrix3X& Psi,
                      const Matrix3& R_WP, CondensedModes& f) {
  Eigen::Matrix<double, 6, 3> X_P = P_plus.rightCols<3>();
  X_P.topRows<3>() += skew(child.p_PB) * P_plus.bottomRightCorner<3, 3>();
  const Eigen::Matrix<double, 3, 6> M_zr_block = R_WP.transpose() * X_P.transpose();
  const Matrix3 P_ll_P = R_WP.transpose() * P_plus.bottomRightCorner<3, 3>() * R_WP;
  f.Y.noalias() += Psi.transpose() * M_zr_block;
  f.P_Psi.noalias() = P_ll_P * Psi;
  f.M_zz.triangularView<Eigen::Lower>() += Psi.transpose() * f.P_Psi;
}

/// The same through a frame I. With P_I the inertia about Io and Theta = E Psi, E = diag(R J, R), Psi = [Psi_phi; Psi_u]:
///   M_zr += Psi^T E^T P_I X_PI,   M_zz += Psi^T (E^T P_I E) Psi.
void add_through_frame(const Matrix6& P_plus, const BodyMotion& child, const Interface<double>& frame,
                       const Matrix3& R_WP, CondensedModes& f) {
  const Vector3 p_PI = frame.p_PI();
  Matrix6 P_I = Matrix6::Zero();
  add_shifted_inertia(P_plus, child.p_PB - p_PI, P_I);
  const Matrix3 R_WJ = frame.R_WJ();
  Matrix6 P_E;
  P_E << P_I.leftCols<3>() * R_WJ, P_I.rightCols<3>() * R_WP;
  const Matrix3X &Psi_phi = frame.rotation(), &Psi_u = frame.translation();
  Matrix6 X_P_E = P_E;
  X_P_E.topRows<3>() += skew(p_PI) * P_E.bottomRows<3>();
  f.Y.noalias() += Psi_phi.transpose() * X_P_E.leftCols<3>().transpose();
  f.Y.noalias() += Psi_u.transpose() * X_P_E.rightCols<3>().transpose();
  const Eigen::Matrix<double, 3, 6> phi_rows = R_WJ.transpose() * P_E.topRows<3>();
  const Eigen::Matrix<double, 3, 6> u_rows = R_WP.transpose() * P_E.bottomRows<3>();
  f.P_Psi.noalias() = phi_rows.leftCols<3>() * Psi_phi;
  f.P_Psi.noalias() += phi_rows.rightCols<3>() * Psi_u;
  f.M_zz.triangularView<Eigen::Lower>() += Psi_phi.transpose() * f.P_Psi;
  f.P_Psi.noalias() = u_rows.leftCols<3>() * Psi_phi;
  f.P_Psi.noalias() += u_rows.rightCols<3>() * Psi_u;
  f.M_zz.triangularView<Eigen::Lower>() += Psi_u.transpose() * f.P_Psi;
}

/// Adds a child's inertia P+ to the modes of the flexible parent that carries it.
void add_to_flexible_parent(const System& system, const TreeBody& body, const Matrix6& P_plus,
                            const BodyMotion& child, Workspace& ws) {
  const Interface<double> interface = parent_interface<double>(system, body, ws);
  if (interface.translation().cols() == 0) return;
  CondensedModes& f = ws.condensed[system.bodies[body.parent].flexible];
  const Matrix3& R_WP = ws.bodies[body.parent].X_WB.R;
  if (body.on_frame)
    add_through_frame(P_plus, child, interface, R_WP, f);
  else
    add_through_node(P_plus, child, interface.translation(), R_WP, f);
}

/// P+ = P - G G^T, one speed h of the joint after the other: g = P h / sqrt(h^T P h), P <- P - g g^T. A joint with several
/// speeds is a chain of joints with one speed each and nothing between them.
/// @throws NumericsError naming the joint where a pivot h^T P h is no more than what rounding may leave in its place
void eliminate_joint(const TreeBody& body, const BodyMotion& s, Workspace& ws, Matrix6& P) {
  const double least = body.nv == 1 ? kLeastLever * kLeastLever : kLeastPivot;
  const double m = least * P.bottomRightCorner<3, 3>().trace();
  const double J = least * P.topLeftCorner<3, 3>().trace() + m * s.p_MB.squaredNorm();
  std::array<double, 6> rounding;
  for (int i = 0; i < body.nv; ++i) {
    const int j = body.v_start + i;
    const Vector6& h = ws.H[j];
    // of |w|^2 (tr J + tr m |p_MB|^2) + |v|^2 tr m, and what the rounding of earlier pivots adds, by (L_ik/L_kk)^2
    rounding[i] = J * angular(h).squaredNorm() + m * linear(h).squaredNorm();
    for (int k = 0; k < i; ++k) {
      const double share = h.dot(ws.G[body.v_start + k]) * ws.inverse_root[body.v_start + k];
      rounding[i] += share * share * rounding[k];
    }
    const Vector6 Ph = P * h;
    double pivot = h.dot(Ph);
    if (!(pivot > rounding[i])) fail_singular(body, pivot);
    if (ws.stiffening.size() > 0) pivot *= ws.stiffening[j];
    // g g^T = P h (P h)^T / pivot: the next body need not wait for the root
    const Vector6 scaled = Ph * (1 / pivot);
    for (int k = 0; k < 6; ++k) P.col(k) -= Ph[k] * scaled;
    ws.inverse_root[j] = 1 / std::sqrt(pivot);
    ws.G[j] = Ph * ws.inverse_root[j];
  }
}

// From body to body 6-vectors are worked on by halves: the shifts between bodies write 3-vectors, and a load of packets that
// straddle what was just stored in pieces has to wait for the memory.

double power(const Vector6& a, const Vector6& b) {
  return angular(a).dot(angular(b)) + linear(a).dot(linear(b));
}

/// b += a s.
void add_scaled(const Vector6& a, double s, Vector6& b) {
  b.head<3>() += angular(a) * s;
  b.tail<3>() += linear(a) * s;
}

/// e = L^-1 (tau - H^T Z) for the speeds of a joint, which hold tau on entry; Z <- Z + G e, as the parent feels it.
void pass_bias(const TreeBody& body, const Workspace& ws, VectorX& e, Vector6& Z) {
  for (int j = body.v_start; j < body.v_start + body.nv; ++j) {
    e[j] = (e[j] - power(ws.H[j], Z)) * ws.inverse_root[j];
    add_scaled(ws.G[j], e[j], Z);
  }
}

/// v' = L^-T (e - G^T A) for the speeds of a joint, and A <- A + H v': from what the parent hands on to the body.
void accelerate_joint(const TreeBody& body, const Workspace& ws, Vector6& A, VectorX& v_rate) {
  for (int j = body.v_start + body.nv - 1; j >= body.v_start; --j) {
    v_rate[j] = (ws.e[j] - power(ws.G[j], A)) * ws.inverse_root[j];
    add_scaled(ws.H[j], v_rate[j], A);
  }
}

auto modal_part(const FlexibleBody& flexible, VectorX& v) {
  return v.segment(flexible.z_rate_start, flexible.modal.mode_count());
}

/// Bias Z of one body and generalised forces e on its modes before anything is passed on.
void set_own_bias(const System& system, int i, Workspace& ws) {
  const TreeBody& body = system.bodies[i];
  const BodyMotion& s = ws.bodies[i];
  Vector6& Z = ws.articulated[i].Z;
  Z = -s.F_applied;
  if (body.flexible >= 0) {
    const FlexibleMotionT<double>& f = ws.flexible[body.flexible];
    Z.head<3>() += s.X_WB.R * f.modal.t_bias;
    Z.tail<3>() += s.X_WB.R * f.modal.f_bias;
    modal_part(system.flexible[body.flexible], ws.e) = f.load - f.modal.h_bias;
  } else {
    // w x J w
    const Vector3 w = angular(s.V), Jw = ws.articulated[i].J * w;
    Z.head<3>() += w.cross(Jw);
  }
}

void set_biases(const System& system, Terms terms, Workspace& ws) {
  if (terms == Terms::hinge_forces) {
    ws.e = ws.hinge_force;
    for (ArticulatedBody& a : ws.articulated) a.Z.setZero();
  } else {
    ws.e.setZero();
    for (int i = 0; i < static_cast<int>(system.bodies.size()); ++i) set_own_bias(system, i, ws);
  }
}

}  // namespace

[[gnu::flatten]] void factor_inertia(const System& system, Workspace& ws, double implicit_step) {
  ++ws.work.inertia;
  const int n = static_cast<int>(system.bodies.size());
  for (int i = 0; i < n; ++i) {
    const TreeBody& body = system.bodies[i];
    const int k = body.flexible;
    if (k >= 0) {
      set_own_inertia(system.flexible[k], ws.bodies[i], ws.flexible[k].modal, ws.articulated[i],
                      ws.condensed[k]);
      set_modal_mass(system.flexible[k], implicit_step, ws.condensed[k]);
    } else {
      set_own_inertia(body, ws.bodies[i], ws.articulated[i]);
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    Matrix6& P = ws.articulated[i].P;
    if (body.flexible >= 0) condense_modes(system.flexible[body.flexible], P, ws.condensed[body.flexible]);
    eliminate_joint(body, s, ws, P);
    if (body.parent < 0) continue;
    add_shifted_inertia(P, s.p_PB, ws.articulated[body.parent].P);
    if (body.parent_interface >= 0) add_to_flexible_parent(system, body, P, s, ws);
  }
}

[[gnu::flatten]] void calc_bias(const System& system, Terms terms, Workspace& ws) {
  ++ws.work.solves;
  set_biases(system, terms, ws);
  for (int i = static_cast<int>(system.bodies.size()) - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    ArticulatedBody& a = ws.articulated[i];
    if (body.flexible >= 0) {
      // e_z = L_z^-1 (Q - h - what hangs on the interfaces)
      const CondensedModes& f = ws.condensed[body.flexible];
      auto e_z = modal_part(system.flexible[body.flexible], ws.e);
      f.solve(e_z);
      a.Z.noalias() += f.Y.transpose() * e_z;
    }
    pass_bias(body, ws, ws.e, a.Z);
    if (body.parent < 0) continue;
    // Z+ = Z + G e + P+ c
    Vector3 t = angular(a.Z), f = linear(a.Z);
    if (terms == Terms::all) {
      const Vector6 Pc = a.P * s.c;
      t += angular(Pc);
      f += linear(Pc);
    }
    Vector6& Z_P = ws.articulated[body.parent].Z;
    Z_P.head<3>() += t + s.p_PB.cross(f);
    Z_P.tail<3>() += f;
    if (body.parent_interface >= 0) {
      const FlexibleBody& parent = system.flexible[system.bodies[body.parent].flexible];
      parent_interface<double>(system, body, ws).add_load(-t, -f, s.p_PB, modal_part(parent, ws.e));
    }
  }
}

[[gnu::flatten]] void calc_accelerations(const System& system, Terms terms, Workspace& ws, VectorX& v_rate) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    BodyMotion& s = ws.bodies[i];
    Vector6 A = Vector6::Zero();
    if (terms == Terms::all) A = s.c;
    if (body.parent >= 0) {
      const BodyMotion& parent = ws.bodies[body.parent];
      A.head<3>() += angular(parent.A);
      A.tail<3>() += linear(parent.A) + angular(parent.A).cross(s.p_PB);
      if (body.parent_interface >= 0) {
        const VectorX& z_dd = ws.flexible[system.bodies[body.parent].flexible].z_dd;
        A += parent_interface<double>(system, body, ws).acceleration(z_dd, s.p_PB);
      }
    }
    accelerate_joint(body, ws, A, v_rate);
    s.A = A;
    if (body.flexible >= 0) {
      // z'' = L_z^-T (e_z - Y A)
      const FlexibleBody& flexible = system.flexible[body.flexible];
      const CondensedModes& f = ws.condensed[body.flexible];
      VectorX& z_dd = ws.flexible[body.flexible].z_dd;
      z_dd = modal_part(flexible, ws.e);
      z_dd.noalias() -= f.Y * s.A;
      f.solve_transposed(z_dd);
      modal_part(flexible, v_rate) = z_dd;
    }
  }
}

void pass_through_joint(const TreeBody& body, const Workspace& ws, Eigen::Ref<Matrix6X> z,
                        Eigen::Ref<MatrixX> U) {
  for (Eigen::Index column = 0; column < z.cols(); ++column) {
    Vector6 Z = z.col(column);
    for (int i = 0; i < body.nv; ++i) {
      const int j = body.v_start + i;
      U(i, column) = ws.H[j].dot(Z) * ws.inverse_root[j];
      Z -= ws.G[j] * U(i, column);
    }
    z.col(column) = Z;
  }
}

}  // namespace wishbone
