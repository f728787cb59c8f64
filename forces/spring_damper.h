#pragma once

#include <string>
#include <vector>

#include "forces/force_element.h"

namespace wishbone {

/// What a spring-damper reports.
struct SpringDamperOutput {
  double length = 0;  ///< l [m]
  double rate = 0;    ///< l' [m/s]
  double force = 0;   ///< f [N], positive in tension
};

/// Point-to-point spring and damper between the origins of two markers P and Q:
///     l = |p_PQ|,  u = p_PQ/l,  l' = u.(v_Q - v_P),  f = k (l - l0) + c l';  force +f u on P, -f u on Q; no
///     moments.
/// Energy k (l - l0)^2/2. The direction u is undefined at l = 0; a spring of free length zero needs none there: its force is
/// k p_PQ + c (v_Q - v_P), as when both ends part along their relative velocity.
/// @throws NumericsError from apply and output naming the element and the time when P and Q coincide and l0 is not zero
class SpringDamper {
 public:
  /// @param stiffness k >= 0 [N/m]  @param damping c >= 0 [N s/m]  @param free_length l0 >= 0 [m]
  /// @throws InputError naming the element when a value is out of range or both ends are one marker
  SpringDamper(std::string name, MarkerIndex P, MarkerIndex Q, double stiffness, double damping,
               double free_length);

  const std::string& name() const { return name_; }
  MarkerIndex P() const { return P_; }
  MarkerIndex Q() const { return Q_; }
  double stiffness() const { return stiffness_; }
  double free_length() const { return free_length_; }
  /// For preloading, where the free length is solved for; any finite value [m].
  void set_free_length(double free_length) { free_length_ = free_length; }

  int state_count() const { return 0; }
  std::vector<MarkerIndex> markers() const;
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput& input) const;
  SpringDamperOutput output(const ForceInput& input) const;

 private:
  template <class T>
  struct Line {
    T length;           // l
    T rate;             // l'
    T tension;          // f
    Vector3T<T> force;  // f u
  };
  template <class T>
  Line<T> line(const ForceInputT<T>& input) const;
  template <class T>
  Line<T> line_of_no_length(const Vector3T<T>& p_PQ, const Vector3T<T>& v_PQ, double time) const;

  std::string name_;
  MarkerIndex P_, Q_;
  double stiffness_, damping_, free_length_;
};

}  // namespace wishbone
