#pragma once

#include <array>

#include "bodies/gauge.h"

namespace wishbone {

/// B travels along the z axis of A by `pitch` [m/rad] times the angle it has turned about it, whole turns included:
/// Phi = z_A . p_AB - pitch angle [m].
struct ScrewTravel {
  static constexpr int kRows = 1;
  static constexpr int kAngles = 0;
  static constexpr int kGauges = 1;
  static constexpr std::array<const char*, 1> kDirections{"travel"};

  double pitch = 0;

  const Gauge& gauge() const { return kAngle; }

  template <class T>
  void residual(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B, const double* near,
                T* Phi) const {
    Phi[0] = kTravel.value(A, B, 0) - pitch * kAngle.value(A, B, near[0]);
  }
  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W_A, T* W_B) const {
    Vector6T<T> travel_A, travel_B, angle_A, angle_B;
    kTravel.wrenches(A, B, travel_A, travel_B);
    kAngle.wrenches(A, B, angle_A, angle_B);
    Eigen::Map<Vector6T<T>>{W_A} = travel_A - angle_A * pitch;
    Eigen::Map<Vector6T<T>>{W_B} = travel_B - angle_B * pitch;
  }
  template <class T>
  void time_rate(double, T* Phi_t) const {
    Phi_t[0] = T(0);
  }
  template <class T>
  void acceleration(double, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                    const MarkerAccelerationT<T>& a_A, const MarkerAccelerationT<T>& a_B, T* Phi_dd) const {
    Phi_dd[0] = kTravel.acceleration(A, B, a_A, a_B) - pitch * kAngle.acceleration(A, B, a_A, a_B);
  }

 private:
  static constexpr Gauge kTravel{Gauge::Kind::translation, 2};
  static constexpr Gauge kAngle{Gauge::Kind::rotation};
};

}  // namespace wishbone
