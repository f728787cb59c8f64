#include "forces/spring_damper.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "bodies/gauge_domain.h"
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
  require(stiffness >= 0 && std::isfinite(stiffness), name_, "the stiffness must be finite and not negative",
          stiffness, "give it in N/m, positive");
  require(damping >= 0 && std::isfinite(damping), name_, "the damping must be finite and not negative",
          damping, "give it in N s/m, positive");
  require(free_length >= 0 && std::isfinite(free_length), name_,
          "the free length must be finite and not negative", free_length, "give it in m, positive");
}

template <class T>
SpringDamper::Line<T> SpringDamper::line(const ForceInputT<T>& input) const {
  const MarkerStateT<T>& P = input.markers[P_];
  const MarkerStateT<T>& Q = input.markers[Q_];
  const Vector3T<T> p_PQ = Q.p_WM - P.p_WM, v_PQ = Q.v_WM - P.v_WM;
  if (!(p_PQ.squaredNorm() > 0)) return line_of_no_length(p_PQ, v_PQ, input.time);
  Line<T> s;
  s.length = p_PQ.norm();
  const Vector3T<T> u = p_PQ / s.length;
  s.rate = u.dot(v_PQ);
  s.tension = stiffness_ * (s.length - free_length_) + damping_ * s.rate;
  s.force = s.tension * u;
  return s;
}

template <class T>
SpringDamper::Line<T> SpringDamper::line_of_no_length(const Vector3T<T>& p_PQ, const Vector3T<T>& v_PQ,
                                                      double time) const {
  if (free_length_ != 0)
    throw NumericsError({fmt::format("{} at t = {} s", name_, time),
                         "the ends of the spring must not coincide: length [m]", "0",
                         "move one of its points, or model the connection by a joint"});
  Line<T> s;
  s.length = T(0);
  s.rate = norm_or_zero(v_PQ);
  s.tension = damping_ * s.rate;
  s.force = stiffness_ * p_PQ + damping_ * v_PQ;
  return s;
}

std::vector<MarkerIndex> SpringDamper::markers() const {
  return {P_, Q_};
}

template <class T>
void SpringDamper::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  const Line<T> s = line(input);
  output.wrenches[P_].f += s.force;
  output.wrenches[Q_].f -= s.force;
  output.power = -s.tension * s.rate;
}

double SpringDamper::energy(const ForceInput& input) const {
  const double stretch = (input.markers[Q_].p_WM - input.markers[P_].p_WM).norm() - free_length_;
  return 0.5 * stiffness_ * stretch * stretch;
}

SpringDamperOutput SpringDamper::output(const ForceInput& input) const {
  const Line<double> s = line(input);
  return {s.length, s.rate, s.tension};
}

template void SpringDamper::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void SpringDamper::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
