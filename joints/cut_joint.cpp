#include "joints/cut_joint.h"

#include "core/dual.h"

namespace wishbone {
namespace {
template <class T>
void sph_res(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* Phi) {
  Eigen::Map<Vector3T<T>>{Phi} = A.R_WM.transpose() * (B.p_WM - A.p_WM);
}
template <class T>
void sph_w(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W, int rows) {
  Eigen::Map<Matrix6XT<T>> W_A(W, 6, 3), W_B(W + 6 * rows, 6, 3);
  const Vector3T<T> d = B.p_WM - A.p_WM;
  const Matrix3T<T> S = skew(d);
  W_A.template bottomRows<3>() = -A.R_WM;
  W_A.template topRows<3>() = -(S * A.R_WM);
  W_B.template bottomRows<3>() = A.R_WM;
  W_B.template topRows<3>().setZero();
}
template <class T>
void sph_a(const MarkerStateT<T>& A, const MarkerStateT<T>& B, const MarkerAccelerationT<T>& a_A,
           const MarkerAccelerationT<T>& a_B, T* out) {
  const Vector3T<T> d = B.p_WM - A.p_WM;
  const Vector3T<T> d_rate = B.v_WM - A.v_WM;
  Eigen::Map<Vector3T<T>>{out} = A.R_WM.transpose() * (a_B.a - a_A.a - a_A.alpha.cross(d) - 2.0 * A.w_WM.cross(d_rate) + A.w_WM.cross(A.w_WM.cross(d)));
}
}  // namespace
template <class T>
void SphericalClosure::residual(double, Sides<T> s, const double*, T* Phi) const { sph_res(s[0], s[1], Phi); }
template <class T>
void SphericalClosure::wrenches(Sides<T> s, T* W) const { sph_w(s[0], s[1], W, 3); }
template <class T>
void SphericalClosure::acceleration(double, Sides<T> s, MarkerAccelerations<T> a, T* out) const { sph_a(s[0], s[1], a[0], a[1], out); }
template <class T>
void RevoluteClosure::residual(double, Sides<T> s, const double*, T* Phi) const {
  sph_res(s[0], s[1], Phi);
  Phi[3] = s[0].R_WM.col(2).dot(s[1].R_WM.col(0));
  Phi[4] = s[0].R_WM.col(2).dot(s[1].R_WM.col(1));
}
template <class T>
void RevoluteClosure::wrenches(Sides<T> s, T* W) const {
  sph_w(s[0], s[1], W, 5);
  Eigen::Map<Matrix6XT<T>> W_A(W, 6, 5), W_B(W + 30, 6, 5);
  for (int i = 0; i < 2; ++i) {
    const Vector3T<T> n = s[0].R_WM.col(2).cross(s[1].R_WM.col(i));
    W_A.col(3 + i) << n, Vector3T<T>::Zero();
    W_B.col(3 + i) << -n, Vector3T<T>::Zero();
  }
}
template <class T>
void RevoluteClosure::acceleration(double, Sides<T> s, MarkerAccelerations<T> a, T* out) const {
  sph_a(s[0], s[1], a[0], a[1], out);
  const Vector3T<T> z = s[0].R_WM.col(2);
  const Vector3T<T> z_rate = s[0].w_WM.cross(z);
  const Vector3T<T> z_dd = a[0].alpha.cross(z) + s[0].w_WM.cross(z_rate);
  for (int i = 0; i < 2; ++i) {
    const Vector3T<T> e = s[1].R_WM.col(i);
    const Vector3T<T> e_rate = s[1].w_WM.cross(e);
    const Vector3T<T> e_dd = a[1].alpha.cross(e) + s[1].w_WM.cross(e_rate);
    out[3 + i] = z_dd.dot(e) + 2.0 * z_rate.dot(e_rate) + z.dot(e_dd);
  }
}
#define I(C, T) template void C::residual(double, Sides<T>, const double*, T*) const; template void C::wrenches(Sides<T>, T*) const; template void C::acceleration(double, Sides<T>, MarkerAccelerations<T>, T*) const;
I(SphericalClosure, double) I(SphericalClosure, Dual) I(RevoluteClosure, double) I(RevoluteClosure, Dual)

}  // namespace wishbone
