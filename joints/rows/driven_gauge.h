#pragma once

#include <array>
#include <string>

#include "bodies/gauge_domain.h"
#include "joints/motion.h"

namespace wishbone {

/// A gauge follows a motion: Phi = u - motion(t) [m or rad].
/// @throws NumericsError from its evaluations, naming `name`, where a distance has shrunk to zero
struct DrivenGauge {
  static constexpr int kRows = 1;
  static constexpr int kAngles = 0;  // by type; DrivenClosure knows
  static constexpr int kGauges = 1;
  static constexpr std::array<const char*, 1> kDirections{"drive"};

  std::string name;
  Gauge measure;
  Motion motion;

  const Gauge& gauge() const { return measure; }

  template <class T>
  void residual(double t, const MarkerStateT<T>& A, const MarkerStateT<T>& B, const double* near,
                T* Phi) const {
    require_defined(measure, A, B, name);
    Phi[0] = measure.value(A, B, near[0]) - motion.at(t).position;
  }
  template <class T>
  void wrenches(const MarkerStateT<T>& A, const MarkerStateT<T>& B, T* W_A, T* W_B) const {
    require_defined(measure, A, B, name);
    Vector6T<T> on_A, on_B;
    measure.wrenches(A, B, on_A, on_B);
    Eigen::Map<Vector6T<T>>{W_A} = on_A;
    Eigen::Map<Vector6T<T>>{W_B} = on_B;
  }
  template <class T>
  void time_rate(double t, T* Phi_t) const {
    Phi_t[0] = T(-motion.at(t).rate);
  }
  template <class T>
  void acceleration(double t, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                    const MarkerAccelerationT<T>& a_A, const MarkerAccelerationT<T>& a_B, T* Phi_dd) const {
    require_defined(measure, A, B, name);
    Phi_dd[0] = measure.acceleration(A, B, a_A, a_B) - motion.at(t).acceleration;
  }
};

}  // namespace wishbone
