#include "forces/spring_damper.h"

#include <fmt/format.h>

#include <utility>

#include "core/dual.h"
#include "core/require.h"

namespace wishbone {

SpringDamper::SpringDamper(std::string name, MarkerIndex P, MarkerIndex Q, double stiffness, double damping,
                           double free_length)
    : name_(std::move(name)),
      P_(P),
      Q_(Q),
      stiffness_(stiffness),
      damping_(damping),
      free_length_(free_length) {
  require(P != Q, name_, "the two ends must be different markers", P,
          "attach the second end to another marker");
  require(stiffness >= 0, name_, "the stiffness must not be negative", stiffness, "give it in N/m, positive");
  require(damping >= 0, name_, "the damping must not be negative", damping, "give it in N s/m, positive");
  require(free_length >= 0, name_, "the free length must not be negative", free_length,
          "give it in m, positive");
}

template <class T>
SpringDamper::Line<T> SpringDamper::line(const ForceInputT<T>& input) const {
  const MarkerStateT<T>& P = input.markers[P_];
  const MarkerStateT<T>& Q = input.markers[Q_];
  const Vector3T<T> p_PQ = Q.p_WM - P.p_WM;
  Line<T> s;
  s.length = p_PQ.norm();
  if (!(s.length > 0)) {
    throw NumericsError({fmt::format("{} at t = {} s", name_, input.time),
                         "the ends of the spring must not coincide: length [m]",
                         fmt::format("{:g}", value_of(s.length)),
                         "move one of its points, or model the connection by a joint"});
  }
  s.u = p_PQ / s.length;
  s.rate = s.u.dot(Q.v_WM - P.v_WM);
  s.force = stiffness_ * (s.length - free_length_) + damping_ * s.rate;
  return s;
}

std::vector<MarkerIndex> SpringDamper::markers() const {
  return {P_, Q_};
}

template <class T>
void SpringDamper::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  const Line<T> s = line(input);
  output.wrenches[P_].f += s.force * s.u;
  output.wrenches[Q_].f -= s.force * s.u;
  output.power = -s.force * s.rate;
}

double SpringDamper::energy(const ForceInput& input) const {
  const double stretch = (input.markers[Q_].p_WM - input.markers[P_].p_WM).norm() - free_length_;
  return 0.5 * stiffness_ * stretch * stretch;
}

SpringDamperOutput SpringDamper::output(const ForceInput& input) const {
  const Line<double> s = line(input);
  return {s.length, s.rate, s.force};
}

template void SpringDamper::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void SpringDamper::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
