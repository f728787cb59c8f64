#include "joints/cut_joint.h"

namespace wishbone {

void SphericalClosure::residual(const MarkerState& A, const MarkerState& B,
                                Eigen::Ref<ClosureVector<3>> Phi) const {
  Phi = A.R_WM.transpose() * (B.p_WM - A.p_WM);
}

void SphericalClosure::wrenches(const MarkerState& A, const MarkerState& B,
                                Eigen::Ref<ClosureWrenches<3>> W_A,
                                Eigen::Ref<ClosureWrenches<3>> W_B) const {
  // Phi' = R_AW (v_B - v_A - w_A x d), d = p_AB: both forces act at the origin of B
  const Vector3 d = B.p_WM - A.p_WM;
  W_A.bottomRows<3>() = -A.R_WM;
  W_A.topRows<3>() = -skew(d) * A.R_WM;
  W_B.bottomRows<3>() = A.R_WM;
  W_B.topRows<3>().setZero();
}

void SphericalClosure::acceleration(const MarkerState& A, const MarkerState& B, const MarkerAcceleration& a_A,
                                    const MarkerAcceleration& a_B,
                                    Eigen::Ref<ClosureVector<3>> Phi_dd) const {
  // Phi'' = R_AW (d'' - alpha_A x d - 2 w_A x d' + w_A x (w_A x d))
  const Vector3 d = B.p_WM - A.p_WM;
  const Vector3 d_rate = B.v_WM - A.v_WM;
  Phi_dd = A.R_WM.transpose() *
           (a_B.a - a_A.a - a_A.alpha.cross(d) - 2.0 * A.w_WM.cross(d_rate) + A.w_WM.cross(A.w_WM.cross(d)));
}

void RevoluteClosure::residual(const MarkerState& A, const MarkerState& B,
                               Eigen::Ref<ClosureVector<5>> Phi) const {
  SphericalClosure{}.residual(A, B, Phi.head<3>());
  Phi[3] = A.R_WM.col(2).dot(B.R_WM.col(0));
  Phi[4] = A.R_WM.col(2).dot(B.R_WM.col(1));
}

void RevoluteClosure::wrenches(const MarkerState& A, const MarkerState& B, Eigen::Ref<ClosureWrenches<5>> W_A,
                               Eigen::Ref<ClosureWrenches<5>> W_B) const {
  SphericalClosure{}.wrenches(A, B, W_A.leftCols<3>(), W_B.leftCols<3>());
  // d/dt (z_A . x_B) = (w_A - w_B) . (z_A x x_B)
  for (int i = 0; i < 2; ++i) {
    const Vector3 n = A.R_WM.col(2).cross(B.R_WM.col(i));
    W_A.col(3 + i) << n, Vector3::Zero();
    W_B.col(3 + i) << -n, Vector3::Zero();
  }
}

void RevoluteClosure::acceleration(const MarkerState& A, const MarkerState& B, const MarkerAcceleration& a_A,
                                   const MarkerAcceleration& a_B, Eigen::Ref<ClosureVector<5>> Phi_dd) const {
  SphericalClosure{}.acceleration(A, B, a_A, a_B, Phi_dd.head<3>());
  // (z_A . x_B)'' = z_A'' . x_B + 2 z_A' . x_B' + z_A . x_B'',  e'' = alpha x e + w x (w x e)
  const Vector3 z = A.R_WM.col(2);
  const Vector3 z_rate = A.w_WM.cross(z);
  const Vector3 z_dd = a_A.alpha.cross(z) + A.w_WM.cross(z_rate);
  for (int i = 0; i < 2; ++i) {
    const Vector3 e = B.R_WM.col(i);
    const Vector3 e_rate = B.w_WM.cross(e);
    const Vector3 e_dd = a_B.alpha.cross(e) + B.w_WM.cross(e_rate);
    Phi_dd[3 + i] = z_dd.dot(e) + 2.0 * z_rate.dot(e_rate) + z.dot(e_dd);
  }
}

}  // namespace wishbone
