#pragma once

#include <array>

#include "bodies/marker.h"
#include "joints/rows/steady_rows.h"

namespace wishbone {

/// A and B do not twist against each other as seen along their shafts z, however these are bent: the rotation vector of
/// R_AB has no part along z, Phi = x_A . y_B - y_A . x_B [rad].
struct NoTwist : SteadyRows<1, 1> {
  static constexpr std::array<const char*, 1> kDirections{"twist"};

  template <class T>
  void residual(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B, const double*, T* Phi) const {
    Phi[0] = A.R_WM.col(0).dot(B.R_WM.col(1)) - A.R_WM.col(1).dot(B.R_WM.col(0));
  }
  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W_A, T* W_B) const {
    // Phi' = n . (w_B - w_A),  n = y_B x x_A - x_B x y_A
    set_moments<T>(B.R_WM.col(1).cross(A.R_WM.col(0)) - B.R_WM.col(0).cross(A.R_WM.col(1)), W_A, W_B);
  }
  template <class T>
  void acceleration(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                    const MarkerAccelerationT<T>& a_A, const MarkerAccelerationT<T>& a_B, T* Phi_dd) const {
    const Vector3T<T> x_A = A.R_WM.col(0), y_A = A.R_WM.col(1), x_B = B.R_WM.col(0), y_B = B.R_WM.col(1);
    const Vector3T<T>&w_A = A.w_WM, &w_B = B.w_WM;
    const Vector3T<T> n = y_B.cross(x_A) - x_B.cross(y_A);
    const Vector3T<T> n_rate = w_B.cross(y_B).cross(x_A) + y_B.cross(w_A.cross(x_A)) -
                               w_B.cross(x_B).cross(y_A) - x_B.cross(w_A.cross(y_A));
    Phi_dd[0] = n.dot(a_B.alpha - a_A.alpha) + n_rate.dot(w_B - w_A);
  }
};

}  // namespace wishbone
