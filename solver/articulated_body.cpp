#include "solver/articulated_body.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <type_traits>

#include "core/error.h"

namespace wishbone {
namespace {

/// Calls f with the joint's number of speeds as a compile-time constant, so that its matrices have fixed size.
template <class F>
void with_joint_size(int nv, F&& f) {
  switch (nv) {
    case 0:
      return f(std::integral_constant<int, 0>{});
    case 1:
      return f(std::integral_constant<int, 1>{});
    case 2:
      return f(std::integral_constant<int, 2>{});
    case 3:
      return f(std::integral_constant<int, 3>{});
    case 4:
      return f(std::integral_constant<int, 4>{});
    case 5:
      return f(std::integral_constant<int, 5>{});
    default:
      return f(std::integral_constant<int, 6>{});
  }
}

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
  a.P.setZero();
  a.P.topLeftCorner<3, 3>() = s.X_WB.R * body.J_B * s.X_WB.R.transpose();
  a.P.bottomRightCorner<3, 3>().diagonal().setConstant(body.mass);
}

/// Instantaneous inertia J(z), coupling S(z) and unit modal mass; children's shares are added before they come by.
void set_own_inertia(const FlexibleBody& flexible, const BodyMotion& s, const ModalBodyState& modal,
                     ArticulatedBody& a, CondensedModes& f) {
  a.P.setZero();
  a.P.topLeftCorner<3, 3>() = s.X_WB.R * modal.J * s.X_WB.R.transpose();
  a.P.bottomRightCorner<3, 3>().diagonal().setConstant(flexible.modal.mass());
  f.Y.leftCols<3>().noalias() = modal.S.transpose() * s.X_WB.R.transpose();
  f.Y.rightCols<3>().setZero();
  if (flexible.carries_joints) f.M_zz.setIdentity();
}

/// P = M_rr - Y^T Y with Y = L_z^-1 M_zr.
void condense_modes(const FlexibleBody& flexible, ArticulatedBody& a, CondensedModes& f) {
  if (flexible.carries_joints) {
    Eigen::LLT<Eigen::Ref<MatrixX>> factor(f.M_zz);  // in place
    f.M_zz.triangularView<Eigen::Lower>().solveInPlace(f.Y);
    a.P.noalias() -= f.Y.transpose() * f.Y;
  } else {
    const Matrix3 SS = f.Y.leftCols<3>().transpose() * f.Y.leftCols<3>();
    a.P.topLeftCorner<3, 3>() -= SS;
  }
}

/// Adds a child's inertia P+ (about the child's origin) to a flexible parent through the node that carries it:
/// A_child = shift(A_parent) + (0, R Psi z'').
void add_to_flexible_parent(const Matrix6& P_plus, const BodyMotion& child, const TreeBody& body,
                            const FlexibleBody& parent_flexible, const Matrix3& R_WP, CondensedModes& f) {
  const Matrix3X& Psi = parent_flexible.modal.interface_shape(body.parent_node);  // 3 x m, parent axes
  if (Psi.cols() == 0) return;
  Eigen::Matrix<double, 6, 3> X_P = P_plus.rightCols<3>();
  X_P.topRows<3>() += skew(child.p_PB) * P_plus.bottomRightCorner<3, 3>();
  const Eigen::Matrix<double, 3, 6> M_zr_block = R_WP.transpose() * X_P.transpose();
  const Matrix3 P_ll_P = R_WP.transpose() * P_plus.bottomRightCorner<3, 3>() * R_WP;
  f.Y.noalias() += Psi.transpose() * M_zr_block;
  f.P_Psi.noalias() = P_ll_P * Psi;
  f.M_zz.triangularView<Eigen::Lower>() += Psi.transpose() * f.P_Psi;
}

/// What the pivots are shares of, for each speed |w|^2 (tr J + tr m |p_MB|^2) + |v|^2 tr m with (w, v) its column of H.
template <int nv>
Eigen::Matrix<double, nv, 1> pivot_scales(const BodyMotion& s, const Matrix6& P) {
  const double m = P.bottomRightCorner<3, 3>().trace();
  const double J = P.topLeftCorner<3, 3>().trace() + m * s.p_MB.squaredNorm();
  const auto H = s.H.leftCols<nv>();
  return J * H.template topRows<3>().colwise().squaredNorm() +
         m * H.template bottomRows<3>().colwise().squaredNorm();
}

/// @param rounding what rounding may leave in place of each pivot; of a pivot it goes on to the later ones by (L_ij/L_jj)^2
/// @throws NumericsError naming the joint where a pivot is no more than that
template <int nv>
void require_pivots(const TreeBody& body, const Eigen::Matrix<double, nv, nv>& L,
                    Eigen::Matrix<double, nv, 1> rounding) {
  for (int i = 0; i < nv; ++i) {
    for (int j = 0; j < i; ++j) {
      const double share = L(i, j) / L(j, j);
      rounding[i] += share * share * rounding[j];
    }
    const double pivot = L(i, i) * L(i, i);
    if (pivot <= rounding[i]) fail_singular(body, pivot);
  }
}

/// `stiffening`: factors on the hinge inertia of the joint's speeds, D <- W D W with W = diag(sqrt); null for none.
template <int nv>
void factor_joint(const TreeBody& body, const BodyMotion& s, const double* stiffening, ArticulatedBody& a,
                  Matrix6& P_plus) {
  P_plus = a.P;
  if constexpr (nv > 0) {
    const Eigen::Matrix<double, 6, nv> H = s.H.leftCols<nv>();
    const Eigen::Matrix<double, 6, nv> PH = a.P * H;
    Eigen::Matrix<double, nv, nv> D = H.transpose() * PH;
    Eigen::Matrix<double, nv, 1> scales = pivot_scales<nv>(s, a.P);
    if (stiffening) {
      const Eigen::Map<const Eigen::Matrix<double, nv, 1>> factors(stiffening);
      const Eigen::Matrix<double, nv, 1> w = factors.cwiseSqrt();
      D = w.asDiagonal() * D * w.asDiagonal();
      scales = scales.cwiseProduct(factors).eval();
    }
    if constexpr (nv == 1) {
      if (!(D(0, 0) > kLeastLever * kLeastLever * scales[0])) fail_singular(body, D(0, 0));
      a.L(0, 0) = std::sqrt(D(0, 0));
      a.G.col(0) = PH / a.L(0, 0);
    } else {
      const Eigen::LLT<Eigen::Matrix<double, nv, nv>> llt(D);
      if (llt.info() != Eigen::Success) fail_singular(body, 0);
      const Eigen::Matrix<double, nv, nv> L = llt.matrixL();
      require_pivots<nv>(body, L, kLeastPivot * scales);
      a.L.template topLeftCorner<nv, nv>() = L;
      // G L^T = P H
      a.G.template leftCols<nv>() =
          L.template triangularView<Eigen::Lower>().solve(PH.transpose()).transpose();
    }
    P_plus.noalias() -= a.G.template leftCols<nv>() * a.G.template leftCols<nv>().transpose();
  }
}

/// Z+ = Z + P c + G e with e = L^-1 (tau - H^T (Z + P c)). On entry e holds the hinge forces tau.
template <int nv>
void pass_bias(const BodyMotion& s, const ArticulatedBody& a, bool with_velocity_products, double* e,
               Vector6& Z_plus) {
  Z_plus = a.Z;
  if (with_velocity_products) Z_plus.noalias() += a.P * s.c;
  if constexpr (nv > 0) {
    Eigen::Map<Eigen::Matrix<double, nv, 1>> e_joint(e);
    e_joint.noalias() -= s.H.template leftCols<nv>().transpose() * Z_plus;
    if constexpr (nv == 1)
      e[0] /= a.L(0, 0);
    else
      a.L.template topLeftCorner<nv, nv>().template triangularView<Eigen::Lower>().solveInPlace(e_joint);
    Z_plus.noalias() += a.G.template leftCols<nv>() * e_joint;
  }
}

/// v' = L^-T (e - G^T A_in),  A = A_in + H v' + c, with A_in the acceleration that the parent hands on.
template <int nv>
void accelerate(BodyMotion& s, const ArticulatedBody& a, bool with_velocity_products, const Vector6& A_in,
                const double* e, double* v_rate) {
  s.A = A_in;
  if (with_velocity_products) s.A += s.c;
  if constexpr (nv > 0) {
    using Speeds = Eigen::Matrix<double, nv, 1>;
    Speeds vd = Eigen::Map<const Speeds>(e) - a.G.template leftCols<nv>().transpose() * A_in;
    if constexpr (nv == 1)
      vd[0] /= a.L(0, 0);
    else
      a.L.template topLeftCorner<nv, nv>().template triangularView<Eigen::Lower>().transpose().solveInPlace(
          vd);
    Eigen::Map<Speeds>{v_rate} = vd;
    s.A.noalias() += s.H.template leftCols<nv>() * vd;
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
    modal_part(system.flexible[body.flexible], ws.e) = f.load - f.modal.h_bias;
  } else {
    // w x J w
    const Vector3 w_B = s.X_WB.R.transpose() * angular(s.V);
    Z.head<3>() += s.X_WB.R * w_B.cross(body.J_B * w_B);
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

void factor_inertia(const System& system, Workspace& ws) {
  ++ws.work.inertia;
  const int n = static_cast<int>(system.bodies.size());
  for (int i = 0; i < n; ++i) {
    const TreeBody& body = system.bodies[i];
    const int k = body.flexible;
    if (k >= 0)
      set_own_inertia(system.flexible[k], ws.bodies[i], ws.flexible[k].modal, ws.articulated[i],
                      ws.condensed[k]);
    else
      set_own_inertia(body, ws.bodies[i], ws.articulated[i]);
  }
  const double* stiffening = ws.stiffening.size() > 0 ? ws.stiffening.data() : nullptr;
  for (int i = n - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    ArticulatedBody& a = ws.articulated[i];
    if (body.flexible >= 0) condense_modes(system.flexible[body.flexible], a, ws.condensed[body.flexible]);
    Matrix6 P_plus;
    with_joint_size(body.nv, [&](auto size) {
      factor_joint<size()>(body, s, stiffening ? stiffening + body.v_start : nullptr, a, P_plus);
    });
    if (body.parent < 0) continue;
    ws.articulated[body.parent].P += shift_inertia(P_plus, s.p_PB);
    if (body.parent_node >= 0) {
      const int k = system.bodies[body.parent].flexible;
      add_to_flexible_parent(P_plus, s, body, system.flexible[k], ws.bodies[body.parent].X_WB.R,
                             ws.condensed[k]);
    }
  }
}

void calc_bias(const System& system, Terms terms, Workspace& ws) {
  ++ws.work.solves;
  set_biases(system, terms, ws);
  for (int i = static_cast<int>(system.bodies.size()) - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    ArticulatedBody& a = ws.articulated[i];
    if (body.flexible >= 0) {
      // e_z = L_z^-1 (Q - h - what hangs on the nodes)
      const CondensedModes& f = ws.condensed[body.flexible];
      auto e_z = modal_part(system.flexible[body.flexible], ws.e);
      if (system.flexible[body.flexible].carries_joints)
        f.M_zz.triangularView<Eigen::Lower>().solveInPlace(e_z);
      a.Z.noalias() += f.Y.transpose() * e_z;
    }
    Vector6 Z_plus;
    with_joint_size(body.nv, [&](auto size) {
      pass_bias<size()>(s, a, terms == Terms::all, ws.e.data() + body.v_start, Z_plus);
    });
    if (body.parent < 0) continue;
    ws.articulated[body.parent].Z += shift_wrench(Z_plus, s.p_PB);
    if (body.parent_node >= 0) {
      const FlexibleBody& parent = system.flexible[system.bodies[body.parent].flexible];
      const Vector3 f_P = ws.bodies[body.parent].X_WB.R.transpose() * linear(Z_plus);
      modal_part(parent, ws.e).noalias() -= parent.modal.interface_shape(body.parent_node).transpose() * f_P;
    }
  }
}

void calc_accelerations(const System& system, Terms terms, Workspace& ws, VectorX& v_rate) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    BodyMotion& s = ws.bodies[i];
    Vector6 A_in = Vector6::Zero();
    if (body.parent >= 0) {
      const BodyMotion& parent = ws.bodies[body.parent];
      A_in = shift_velocity(parent.A, s.p_PB);
      if (body.parent_node >= 0) {
        const int k = system.bodies[body.parent].flexible;
        const Vector3 a_P = system.flexible[k].modal.interface_shape(body.parent_node) * ws.flexible[k].z_dd;
        A_in.tail<3>() += parent.X_WB.R * a_P;
      }
    }
    with_joint_size(body.nv, [&](auto size) {
      accelerate<size()>(s, ws.articulated[i], terms == Terms::all, A_in, ws.e.data() + body.v_start,
                         v_rate.data() + body.v_start);
    });
    if (body.flexible >= 0) {
      // z'' = L_z^-T (e_z - Y A)
      const FlexibleBody& flexible = system.flexible[body.flexible];
      const CondensedModes& f = ws.condensed[body.flexible];
      VectorX& z_dd = ws.flexible[body.flexible].z_dd;
      z_dd = modal_part(flexible, ws.e);
      z_dd.noalias() -= f.Y * s.A;
      if (flexible.carries_joints) f.M_zz.triangularView<Eigen::Lower>().transpose().solveInPlace(z_dd);
      modal_part(flexible, v_rate) = z_dd;
    }
  }
}

void pass_through_joint(const TreeBody& body, const BodyMotion& s, const ArticulatedBody& a,
                        Eigen::Ref<Matrix6X> z, Eigen::Ref<MatrixX> U) {
  with_joint_size(body.nv, [&](auto size) {
    constexpr int nv = size();
    if constexpr (nv > 0) {
      for (Eigen::Index j = 0; j < z.cols(); ++j) {
        Eigen::Matrix<double, nv, 1> u = s.H.template leftCols<nv>().transpose() * z.col(j);
        if constexpr (nv == 1)
          u[0] /= a.L(0, 0);
        else
          a.L.template topLeftCorner<nv, nv>().template triangularView<Eigen::Lower>().solveInPlace(u);
        U.col(j).template segment<nv>(0) = u;
        z.col(j).noalias() -= a.G.template leftCols<nv>() * u;
      }
    }
  });
}

}  // namespace wishbone
