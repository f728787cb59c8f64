#include "forces/joint_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wishbone {

JointLimit::JointLimit(std::string name, MarkerIndex A, MarkerIndex B, Gauge gauge,
                       std::optional<double> lower, std::optional<double> upper, Stop stop)
    : coordinate_(std::move(name), A, B, gauge), lower_(lower), upper_(upper), stop_(stop) {
  require(lower || upper, this->name(), "a joint limit needs a lower or an upper limit", 0,
          "give one, in rad or m");
  for (const auto& limit : {lower, upper})
    require(!limit || std::isfinite(*limit), this->name(), "a limit must be finite", limit.value_or(0),
            "leave out the limit that is not there");
  require(!lower || !upper || *lower < *upper, this->name(), "the lower limit must be below the upper one",
          lower.value_or(0), "exchange them");
  require(stop.stiffness > 0 && std::isfinite(stop.stiffness), this->name(),
          "the stiffness must be finite and positive", stop.stiffness, "give it in N m/rad^n or N/m^n");
  require(stop.exponent >= 1 && std::isfinite(stop.exponent), this->name(),
          "the exponent must not be below one", stop.exponent, "1 is a linear stop, 1.5 that of Hertz");
  require(stop.damping >= 0 && std::isfinite(stop.damping), this->name(),
          "the damping must be finite and not negative", stop.damping, "give it in s/rad or s/m");
}

template <class T>
T JointLimit::contact(const T& depth, const T& depth_rate) const {
  using std::pow;
  if (!(depth > 0.0)) return T(0);
  const T f = stop_.stiffness * pow(depth, stop_.exponent) * (1.0 + stop_.damping * depth_rate);
  return f > 0.0 ? f : T(0);
}

template <class T>
T JointLimit::force(const T& u, const T& rate) const {
  T f(0);
  if (lower_) f += contact<T>(*lower_ - u, -rate);
  if (upper_) f -= contact<T>(u - *upper_, rate);
  return f;
}

template <class T>
void JointLimit::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  coordinate_.apply(input, output, [this](const T& u, const T& rate) { return force(u, rate); });
}

double JointLimit::energy(const ForceInput& input) const {
  const double u = coordinate_.value(input);
  const double n = stop_.exponent;
  const auto stored = [&](double depth) {
    return stop_.stiffness * std::pow(std::max(depth, 0.0), n + 1) / (n + 1);
  };
  return (lower_ ? stored(*lower_ - u) : 0.0) + (upper_ ? stored(u - *upper_) : 0.0);
}

JointForceOutput JointLimit::output(const ForceInput& input) const {
  return coordinate_.output(input, [this](double u, double rate) { return force(u, rate); });
}

int JointLimit::segment_at(double u) const {
  if (lower_ && u < *lower_) return 0;
  return upper_ && u > *upper_ ? 2 : 1;
}

Edges JointLimit::edges(int segment) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double lower = lower_.value_or(-kInfinity), upper = upper_.value_or(kInfinity);
  if (segment == 1) return {lower, upper};
  return segment == 0 ? Edges{-kInfinity, lower} : Edges{upper, kInfinity};
}

template void JointLimit::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void JointLimit::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
