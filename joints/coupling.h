#pragma once

#include <array>
#include <string>
#include <vector>

#include "joints/closure.h"
#include "joints/motion.h"

namespace wishbone {

/// A linear relation between gauges, Phi = sum c_i u_i - constant, gauge i measured between participants 2 i and 2 i + 1:
/// gears (two angles), rack and pinion (an angle and a travel), differentials and mixers (three or more).
/// @throws NumericsError from its evaluations, naming the coupling, where a distance has shrunk to zero
class CouplingClosure {
 public:
  static constexpr const char* kKind = "coupling";
  static constexpr int kRows = 1;
  static constexpr std::array<const char*, 1> kDirections{"coupling"};

  struct Term {
    Gauge gauge;
    double coefficient = 1;  ///< c_i, so that all c_i u_i have one unit
  };

  /// @throws InputError naming `name` unless there are terms, with coefficients that are finite and not zero
  CouplingClosure(std::string name, std::vector<Term> terms, double constant = 0);

  /// Whether all that it adds are angles [rad]; else it is read as a length [m].
  bool row_is_angle(int row) const;
  int participant_count() const { return 2 * gauge_count(); }
  int gauge_count() const { return static_cast<int>(terms_.size()); }
  const Gauge& gauge(int i) const { return terms_[i].gauge; }
  double coefficient(int i) const { return terms_[i].coefficient; }
  double constant() const { return constant_; }
  const Motion* drive() const { return nullptr; }

  template <class T>
  void residual(double t, Sides<T> sides, const double* near, T* Phi) const;
  template <class T>
  void wrenches(Sides<T> sides, T* W) const;
  template <class T>
  void time_rate(double /*t*/, T* Phi_t) const {
    Phi_t[0] = T(0);
  }
  template <class T>
  void acceleration(double t, Sides<T> sides, MarkerAccelerations<T> a, T* Phi_dd) const;

 private:
  std::string name_;
  std::vector<Term> terms_;
  double constant_;
};

}  // namespace wishbone
