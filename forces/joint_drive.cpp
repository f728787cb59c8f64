#include "forces/joint_drive.h"

#include <cmath>
#include <utility>

#include "forces/load_function.h"

namespace wishbone {

JointDrive::JointDrive(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, Function force)
    : coordinate_(std::move(name), A, B, gauge), force_(std::move(force)) {
  const double constant = force_.constant().value_or(0);
  require(std::isfinite(constant), this->name(), "the force of a drive must be finite", constant,
          "give it in N m or N");
}

template <class T>
void JointDrive::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  const T f = load_value(force_, input, name());
  coordinate_.apply(input, output, [&f](const T& /*u*/, const T& /*rate*/) { return f; });
}

JointForceOutput JointDrive::output(const ForceInput& input) const {
  const double f = load_value(force_, input, name());
  return coordinate_.output(input, [f](double /*u*/, double /*rate*/) { return f; });
}

template void JointDrive::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void JointDrive::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
