#include "forces/joint_spring.h"

#include <cmath>
#include <utility>

namespace wishbone {

JointSpring::JointSpring(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, double stiffness,
                         double damping, double free_value)
    : coordinate_(std::move(name), A, B, gauge),
      stiffness_(stiffness),
      damping_(damping),
      free_value_(free_value) {
  require(stiffness >= 0 && std::isfinite(stiffness), this->name(),
          "the stiffness must be finite and not negative", stiffness, "give it in N m/rad or N/m");
  require(damping >= 0 && std::isfinite(damping), this->name(), "the damping must be finite and not negative",
          damping, "give it in N m s/rad or N s/m");
  require(std::isfinite(free_value), this->name(), "the free value must be finite", free_value,
          "give it in rad or m");
}

template <class T>
void JointSpring::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  coordinate_.apply(input, output, [this](const T& u, const T& rate) { return force(u, rate); });
}

double JointSpring::energy(const ForceInput& input) const {
  const double deflection = coordinate_.value(input) - free_value_;
  return 0.5 * stiffness_ * deflection * deflection;
}

JointForceOutput JointSpring::output(const ForceInput& input) const {
  return coordinate_.output(input, [this](double u, double rate) { return force(u, rate); });
}

template void JointSpring::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void JointSpring::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
