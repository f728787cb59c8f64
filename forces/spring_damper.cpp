#include "forces/spring_damper.h"

#include <fmt/format.h>

#include <utility>

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

SpringDamper::Line SpringDamper::line(const ForceInput& input) const {
  const MarkerState& P = input.markers[P_];
  const MarkerState& Q = input.markers[Q_];
  const Vector3 p_PQ = Q.p_WM - P.p_WM;
  Line s;
  s.length = p_PQ.norm();
  if (!(s.length > 0)) {
    throw NumericsError({fmt::format("{} at t = {} s", name_, input.time),
                         "the ends of the spring must not coincide: length [m]",
                         fmt::format("{:g}", s.length),
                         "move one of its points, or model the connection by a joint"});
  }
  s.u = p_PQ / s.length;
  s.rate = s.u.dot(Q.v_WM - P.v_WM);
  s.force = stiffness_ * (s.length - free_length_) + damping_ * s.rate;
  return s;
}

void SpringDamper::apply(const ForceInput& input, ForceOutput& output) const {
  const Line s = line(input);
  output.wrenches[P_].f += s.force * s.u;
  output.wrenches[Q_].f -= s.force * s.u;
  output.power = -s.force * s.rate;
}

double SpringDamper::energy(const ForceInput& input) const {
  const double stretch = (input.markers[Q_].p_WM - input.markers[P_].p_WM).norm() - free_length_;
  return 0.5 * stiffness_ * stretch * stretch;
}

SpringDamperOutput SpringDamper::output(const ForceInput& input) const {
  const Line s = line(input);
  return {s.length, s.rate, s.force};
}

}  // namespace wishbone
