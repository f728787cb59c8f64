#pragma once

#include <array>

#include "bodies/marker.h"
#include "joints/rows/steady_rows.h"

namespace wishbone {

/// The axes of B are those of A: Phi = 2 u of the quaternion (c, u) of R_AB with c >= 0 [rad], components in A. It has one
/// zero, unlike three scalar products of axes, which half a turn satisfies as well.
struct OrientationLock : SteadyRows<3, 3> {
  static constexpr std::array<const char*, 3> kDirections{"turn about x", "turn about y", "turn about z"};

  template <class T>
  void residual(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B, const double*, T* Phi) const {
    Eigen::Map<Vector3T<T>>{Phi} = 2.0 * Turn<T>(A, B).u;
  }

  /// Phi' = c w + w x u = (c 1 - u~) w with w = w_AB in A, from the quaternion's rate (0, w) o (c, u)/2.
  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W_A, T* W_B) const {
    const Turn<T> turn(A, B);
    for (int i = 0; i < 3; ++i) {
      // row i of (c 1 - u~) is c e_i + u x e_i
      Vector3T<T> n_A = turn.u.cross(Vector3T<T>::Unit(i));
      n_A[i] += turn.c;
      set_moments<T>(A.R_WM * n_A, W_A + 6 * i, W_B + 6 * i);
    }
  }

  /// Phi'' = c' w + c w' + w' x u + w x u',  c' = -u.w/2,  u' = Phi'/2,  w' as seen from A.
  template <class T>
  void acceleration(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                    const MarkerAccelerationT<T>& a_A, const MarkerAccelerationT<T>& a_B, T* Phi_dd) const {
    const auto [c, u] = Turn<T>(A, B);
    const Vector3T<T> w_AB = B.w_WM - A.w_WM;
    const Vector3T<T> w = A.R_WM.transpose() * w_AB;
    const Vector3T<T> w_rate = A.R_WM.transpose() * (a_B.alpha - a_A.alpha - A.w_WM.cross(w_AB));
    const Vector3T<T> Phi_rate = w * c + w.cross(u);
    Eigen::Map<Vector3T<T>>{Phi_dd} =
        w * (-0.5 * u.dot(w)) + w_rate * c + w_rate.cross(u) + 0.5 * w.cross(Phi_rate);
  }

 private:
  /// The quaternion (c, u) of R_AB with c >= 0.
  template <class T>
  struct Turn {
    T c;
    Vector3T<T> u;

    Turn(const MarkerStateT<T>& A, const MarkerStateT<T>& B) {
      const Matrix3T<T> R_AB = A.R_WM.transpose() * B.R_WM;
      const Eigen::Quaternion<T> Q(R_AB);
      const double sign = Q.w() < 0.0 ? -1.0 : 1.0;
      c = Q.w() * sign;
      u = Q.vec() * sign;
    }
  };
};

}  // namespace wishbone
