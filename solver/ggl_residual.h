#pragma once

#include "solver/evaluation.h"

namespace wishbone {

/// The form of Gear, Gupta and Leimkuhler [1985] as F(t, y, y') = 0 with y = (q, v, x, loss, input, Lambda, Gamma): the
/// multipliers of the kept rows enter as derivatives of their integrals, which makes the index one,
///
///     q' - N (v - D^T Gamma') = 0        M v' - f - D^T Lambda' = 0        x' - X = 0
///     work' - P = 0                      Phi = 0                           D v + Phi_t = 0.
///
/// Written once for the scalar T: double for the residual, Dual for its Jacobian.
template <class T>
class GglResidual {
 public:
  /// @param kept closure rows that multipliers are solved for
  GglResidual(const System& system, const std::vector<int>& kept);

  Eigen::Index size() const { return size_; }
  Evaluation<T>& evaluation() { return ev_; }
  void calc(double t, const T* y, const T* y_rate, T* r);

 private:
  const System& system_;
  std::vector<int> kept_;
  Eigen::Index size_;
  Evaluation<T> ev_;
  VectorXT<T> q_, v_, x_, v_rate_, lambda_, gamma_, q_rate_, speed_, force_;
};

}  // namespace wishbone
