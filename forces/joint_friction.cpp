#include "forces/joint_friction.h"

#include <cmath>
#include <utility>

namespace wishbone {

JointFriction::JointFriction(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge, double coulomb,
                             double smoothing, double viscous, std::optional<StribeckPeak> peak)
    : coordinate_(std::move(name), A, B, gauge),
      coulomb_(coulomb),
      smoothing_(smoothing),
      viscous_(viscous),
      peak_(peak) {
  require(coulomb >= 0 && std::isfinite(coulomb), this->name(),
          "the dry friction must be finite and not negative", coulomb, "give it in N m or N");
  require(smoothing > 0 && std::isfinite(smoothing), this->name(),
          "the smoothing velocity must be finite and positive", smoothing,
          "give it in rad/s or m/s, well below the rates of interest");
  require(viscous >= 0 && std::isfinite(viscous), this->name(),
          "the viscous friction must be finite and not negative", viscous, "give it in N m s/rad or N s/m");
  if (!peak) return;
  require(peak->force >= coulomb && std::isfinite(peak->force), this->name(),
          "the friction at rest must not be below that of sliding", peak->force, "give it in N m or N");
  require(peak->velocity > 0 && std::isfinite(peak->velocity), this->name(),
          "the velocity at which friction falls must be positive", peak->velocity, "give it in rad/s or m/s");
}

template <class T>
T JointFriction::force(const T& rate) const {
  using std::exp;
  using std::tanh;
  T dry(coulomb_);
  if (peak_) {
    const T ratio = rate / peak_->velocity;
    dry += (peak_->force - coulomb_) * exp(-(ratio * ratio));
  }
  return -(dry * tanh(rate / smoothing_) + viscous_ * rate);
}

template <class T>
void JointFriction::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  coordinate_.apply(input, output, [this](const T& /*u*/, const T& rate) { return force(rate); });
}

JointForceOutput JointFriction::output(const ForceInput& input) const {
  return coordinate_.output(input, [this](double /*u*/, double rate) { return force(rate); });
}

template void JointFriction::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void JointFriction::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
