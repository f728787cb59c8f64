#pragma once

#include <array>

#include "bodies/marker.h"
#include "joints/rows/steady_rows.h"

namespace wishbone {

/// Axis i of A stays normal to axis j of B: Phi = i_A . j_B [rad], the sine of the tilt about the third axis.
template <int i, int j>
struct Perpendicular : SteadyRows<1, 1> {
  static_assert(i != j, "a tilt about the third axis");
  static constexpr std::array<const char*, 1> kDirections{i + j == 3   ? "tilt about x"
                                                          : i + j == 2 ? "tilt about y"
                                                                       : "tilt about z"};

  template <class T>
  void residual(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B, const double*, T* Phi) const {
    Phi[0] = A.R_WM.col(i).dot(B.R_WM.col(j));
  }
  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W_A, T* W_B) const {
    // Phi' = i . (w_B - w_A) x j = (j x i) . (w_B - w_A)
    set_moments<T>(B.R_WM.col(j).cross(A.R_WM.col(i)), W_A, W_B);
  }
  template <class T>
  void acceleration(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                    const MarkerAccelerationT<T>& a_A, const MarkerAccelerationT<T>& a_B, T* Phi_dd) const {
    // Phi'' = (j x i) . (alpha_B - alpha_A) + (j' x i + j x i') . (w_B - w_A)
    const Vector3T<T> e = A.R_WM.col(i), e_rate = A.w_WM.cross(e);
    const Vector3T<T> f = B.R_WM.col(j), f_rate = B.w_WM.cross(f);
    Phi_dd[0] =
        f.cross(e).dot(a_B.alpha - a_A.alpha) + (f_rate.cross(e) + f.cross(e_rate)).dot(B.w_WM - A.w_WM);
  }
};

}  // namespace wishbone
