#include "solver/articulated_body.h"

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

[[noreturn]] void fail_singular(const TreeBody& body, double pivot) {
  throw NumericsError({"body '" + body.name + "', joint '" + body.joint_name + "'",
                       "the inertia that moves with the joint is not positive definite",
                       "pivot " + std::to_string(pivot),
                       "give the body, or what hangs on it, mass and inertia about the joint's axes"});
}

void set_own_inertia(const TreeBody& body, BodyState& s) {
  s.P.setZero();
  s.P.topLeftCorner<3, 3>() = s.X_WB.R * body.J_B * s.X_WB.R.transpose();
  s.P.bottomRightCorner<3, 3>().diagonal().setConstant(body.mass);
}

/// Instantaneous inertia J(z), coupling S(z) and unit modal mass; children's shares are added before they come by.
void set_own_inertia(const FlexibleBody& flexible, BodyState& s, FlexibleState& f) {
  s.P.setZero();
  s.P.topLeftCorner<3, 3>() = s.X_WB.R * f.modal.J * s.X_WB.R.transpose();
  s.P.bottomRightCorner<3, 3>().diagonal().setConstant(flexible.modal.mass());
  f.Y.leftCols<3>().noalias() = f.modal.S.transpose() * s.X_WB.R.transpose();
  f.Y.rightCols<3>().setZero();
  if (flexible.carries_joints) f.M_zz.setIdentity();
}

/// P = M_rr - Y^T Y with Y = L_z^-1 M_zr.
void condense_modes(const FlexibleBody& flexible, BodyState& s, FlexibleState& f) {
  if (flexible.carries_joints) {
    Eigen::LLT<Eigen::Ref<MatrixX>> factor(f.M_zz);  // in place
    f.M_zz.triangularView<Eigen::Lower>().solveInPlace(f.Y);
    s.P.noalias() -= f.Y.transpose() * f.Y;
  } else {
    const Matrix3 SS = f.Y.leftCols<3>().transpose() * f.Y.leftCols<3>();
    s.P.topLeftCorner<3, 3>() -= SS;
  }
}

/// Adds a child's inertia P+ (about the child's origin) to a flexible parent through the node that carries it:
/// A_child = shift(A_parent) + (0, R Psi z'').
void add_to_flexible_parent(const Matrix6& P_plus, const BodyState& child, const TreeBody& body,
                            const FlexibleBody& parent_flexible, const Matrix3& R_WP, FlexibleState& f) {
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

template <int nv>
void factor_joint(const TreeBody& body, BodyState& s, Matrix6& P_plus) {
  P_plus = s.P;
  if constexpr (nv > 0) {
    const Eigen::Matrix<double, 6, nv> H = s.H.leftCols<nv>();
    const Eigen::Matrix<double, 6, nv> PH = s.P * H;
    const Eigen::Matrix<double, nv, nv> D = H.transpose() * PH;
    if constexpr (nv == 1) {
      if (!(D(0, 0) > 0)) fail_singular(body, D(0, 0));
      s.L(0, 0) = std::sqrt(D(0, 0));
      s.G.col(0) = PH / s.L(0, 0);
    } else {
      const Eigen::LLT<Eigen::Matrix<double, nv, nv>> llt(D);
      if (llt.info() != Eigen::Success) fail_singular(body, D.diagonal().minCoeff());
      const Eigen::Matrix<double, nv, nv> L = llt.matrixL();
      s.L.template topLeftCorner<nv, nv>() = L;
      // G L^T = P H
      s.G.template leftCols<nv>() =
          L.template triangularView<Eigen::Lower>().solve(PH.transpose()).transpose();
    }
    P_plus.noalias() -= s.G.template leftCols<nv>() * s.G.template leftCols<nv>().transpose();
  }
}

/// Z+ = Z + P c + G e with e = -L^-1 H^T (Z + P c).
template <int nv>
void pass_bias(BodyState& s, bool with_velocity_products, Vector6& Z_plus) {
  Z_plus = s.Z;
  if (with_velocity_products) Z_plus.noalias() += s.P * s.c;
  if constexpr (nv > 0) {
    Eigen::Matrix<double, nv, 1> e = -s.H.template leftCols<nv>().transpose() * Z_plus;
    if constexpr (nv == 1)
      e[0] /= s.L(0, 0);
    else
      s.L.template topLeftCorner<nv, nv>().template triangularView<Eigen::Lower>().solveInPlace(e);
    s.e.template head<nv>() = e;
    Z_plus.noalias() += s.G.template leftCols<nv>() * e;
  }
}

/// v' = L^-T (e - G^T A_in),  A = A_in + H v' + c, with A_in the acceleration that the parent hands on.
template <int nv>
void accelerate(BodyState& s, bool with_velocity_products, const Vector6& A_in, double* v_rate) {
  s.A = A_in;
  if (with_velocity_products) s.A += s.c;
  if constexpr (nv > 0) {
    Eigen::Matrix<double, nv, 1> vd =
        s.e.template head<nv>() - s.G.template leftCols<nv>().transpose() * A_in;
    if constexpr (nv == 1)
      vd[0] /= s.L(0, 0);
    else
      s.L.template topLeftCorner<nv, nv>().template triangularView<Eigen::Lower>().transpose().solveInPlace(
          vd);
    Eigen::Map<Eigen::Matrix<double, nv, 1>>{v_rate} = vd;
    s.A.noalias() += s.H.template leftCols<nv>() * vd;
  }
}

void set_own_bias(const TreeBody& body, bool with_velocity_products, BodyState& s, Workspace& ws) {
  s.Z = -s.F_applied;
  if (body.flexible >= 0) {
    FlexibleState& f = ws.flexible[body.flexible];
    f.bias = -f.load;
    if (with_velocity_products) {
      s.Z.head<3>() += s.X_WB.R * f.modal.t_bias;
      f.bias += f.modal.h_bias;
    }
  } else if (with_velocity_products) {
    // w x J w
    const Vector3 w_B = s.X_WB.R.transpose() * angular(s.V);
    s.Z.head<3>() += s.X_WB.R * w_B.cross(body.J_B * w_B);
  }
}

}  // namespace

void factor_inertia(const System& system, Workspace& ws) {
  ++ws.work.inertia;
  const int n = static_cast<int>(system.bodies.size());
  for (int i = 0; i < n; ++i) {
    const TreeBody& body = system.bodies[i];
    if (body.flexible >= 0)
      set_own_inertia(system.flexible[body.flexible], ws.bodies[i], ws.flexible[body.flexible]);
    else
      set_own_inertia(body, ws.bodies[i]);
  }
  for (int i = n - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    BodyState& s = ws.bodies[i];
    if (body.flexible >= 0) condense_modes(system.flexible[body.flexible], s, ws.flexible[body.flexible]);
    Matrix6 P_plus;
    with_joint_size(body.nv, [&](auto size) { factor_joint<size()>(body, s, P_plus); });
    if (body.parent < 0) continue;
    BodyState& parent = ws.bodies[body.parent];
    parent.P += shift_inertia(P_plus, s.p_PB);
    if (body.parent_node >= 0) {
      const int k = system.bodies[body.parent].flexible;
      add_to_flexible_parent(P_plus, s, body, system.flexible[k], parent.X_WB.R, ws.flexible[k]);
    }
  }
}

void solve_accelerations(const System& system, Terms terms, Workspace& ws, VectorX& v_rate) {
  ++ws.work.solves;
  const bool all = terms == Terms::all;
  const int n = static_cast<int>(system.bodies.size());
  for (int i = 0; i < n; ++i) set_own_bias(system.bodies[i], all, ws.bodies[i], ws);

  for (int i = n - 1; i >= 0; --i) {
    const TreeBody& body = system.bodies[i];
    BodyState& s = ws.bodies[i];
    if (body.flexible >= 0) {
      FlexibleState& f = ws.flexible[body.flexible];
      if (system.flexible[body.flexible].carries_joints)
        f.M_zz.triangularView<Eigen::Lower>().solveInPlace(f.bias);
      s.Z.noalias() -= f.Y.transpose() * f.bias;
    }
    Vector6 Z_plus;
    with_joint_size(body.nv, [&](auto size) { pass_bias<size()>(s, all, Z_plus); });
    if (body.parent < 0) continue;
    BodyState& parent = ws.bodies[body.parent];
    parent.Z += shift_wrench(Z_plus, s.p_PB);
    if (body.parent_node >= 0) {
      const int k = system.bodies[body.parent].flexible;
      const Vector3 f_P = parent.X_WB.R.transpose() * linear(Z_plus);
      ws.flexible[k].bias.noalias() +=
          system.flexible[k].modal.interface_shape(body.parent_node).transpose() * f_P;
    }
  }

  for (int i = 0; i < n; ++i) {
    const TreeBody& body = system.bodies[i];
    BodyState& s = ws.bodies[i];
    Vector6 A_in = Vector6::Zero();
    if (body.parent >= 0) {
      const BodyState& parent = ws.bodies[body.parent];
      A_in = shift_velocity(parent.A, s.p_PB);
      if (body.parent_node >= 0) {
        const int k = system.bodies[body.parent].flexible;
        const Vector3 a_P = system.flexible[k].modal.interface_shape(body.parent_node) * ws.flexible[k].z_dd;
        linear(A_in) += parent.X_WB.R * a_P;
      }
    }
    with_joint_size(body.nv,
                    [&](auto size) { accelerate<size()>(s, all, A_in, v_rate.data() + body.v_start); });
    if (body.flexible >= 0) {
      // z'' = -L_z^-T (L_z^-1 bias + Y A)
      const FlexibleBody& flexible = system.flexible[body.flexible];
      FlexibleState& f = ws.flexible[body.flexible];
      f.z_dd = -f.bias;
      f.z_dd.noalias() -= f.Y * s.A;
      if (flexible.carries_joints) f.M_zz.triangularView<Eigen::Lower>().transpose().solveInPlace(f.z_dd);
      v_rate.segment(flexible.z_rate_start, f.z_dd.size()) = f.z_dd;
    }
  }
}

void pass_through_joint(const TreeBody& body, const BodyState& s, Eigen::Ref<Matrix6X> z,
                        Eigen::Ref<MatrixX> U) {
  with_joint_size(body.nv, [&](auto size) {
    constexpr int nv = size();
    if constexpr (nv > 0) {
      for (Eigen::Index j = 0; j < z.cols(); ++j) {
        Eigen::Matrix<double, nv, 1> u = s.H.template leftCols<nv>().transpose() * z.col(j);
        if constexpr (nv == 1)
          u[0] /= s.L(0, 0);
        else
          s.L.template topLeftCorner<nv, nv>().template triangularView<Eigen::Lower>().solveInPlace(u);
        U.col(j).template segment<nv>(0) = u;
        z.col(j).noalias() -= s.G.template leftCols<nv>() * u;
      }
    }
  });
}

}  // namespace wishbone
