#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/units.h"
#include "models/scene_coordinates.h"

namespace wishbone::scene_sections {
namespace {

struct CoordinateDimensions {
  const Dimension &value, &rate, &force, &stiffness, &damping;
};
CoordinateDimensions dimensions_of(const JointCoordinateKind& coordinate, const Value& value) {
  if (!coordinate.measurable)
    value.refuse("no force can act along this coordinate", "use a force between points of the bodies");
  if (coordinate.is_angle) return {kAngle, kAngularVelocity, kMoment, kTorsionalStiffness, kTorsionalDamping};
  return {kLength, kVelocity, kForce, kStiffness, kDamping};
}

Scene::CoordinateSpring read_joint_spring(int i, const Value& value, const JointCoordinateKind& kind) {
  const Mapping keys(value, {"stiffness", "damping", "free"});
  const CoordinateDimensions d = dimensions_of(kind, value);
  Scene::CoordinateSpring spring;
  spring.coordinate = i;
  if (const auto k = keys.optional("stiffness")) spring.stiffness = k->non_negative(d.stiffness);
  if (const auto c = keys.optional("damping")) spring.damping = c->non_negative(d.damping);
  if (spring.stiffness == 0 && spring.damping == 0)
    value.refuse("the spring has neither stiffness nor damping", "give one of them");
  if (const auto free = keys.optional("free")) spring.free = free->number(d.value);
  return spring;
}

Scene::CoordinateFriction read_joint_friction(int i, const Value& value, const JointCoordinateKind& kind) {
  const Mapping keys(value, {"coulomb", "viscous", "smoothing", "peak", "peak_rate"});
  const CoordinateDimensions d = dimensions_of(kind, value);
  Scene::CoordinateFriction friction;
  friction.coordinate = i;
  friction.smoothing = 1e-3;
  if (const auto f = keys.optional("coulomb")) friction.coulomb = f->non_negative(d.force);
  if (const auto c = keys.optional("viscous")) friction.viscous = c->non_negative(d.damping);
  if (const auto s = keys.optional("smoothing")) friction.smoothing = s->positive(d.rate);
  if (const auto peak = keys.optional("peak")) {
    friction.peak = peak->non_negative(d.force);
    if (*friction.peak < friction.coulomb)
      peak->refuse("friction at rest is less than that of sliding", "give at least 'coulomb'");
    friction.peak_rate = keys.required("peak_rate").positive(d.rate);
  }
  return friction;
}

/// k of f = k d^n in N/m^n or N m/rad^n. Units have whole powers only; for other exponents a plain number is wanted.
double read_stop_stiffness(const Value& value, double exponent, const JointCoordinateKind& kind) {
  const std::string unit = fmt::format("{}{:g}", kind.is_angle ? "N m/rad" : "N/m", exponent);
  if (exponent == 1) return value.positive(kind.is_angle ? kTorsionalStiffness : kStiffness);
  if (exponent == std::floor(exponent) && exponent < 10) return value.positive({"stiffness of a stop", unit});
  const bool has_unit = looks_like_number(value.text()) && !parse_quantity(value.text()).base.empty();
  if (has_unit)
    value.refuse(fmt::format("the stiffness of a stop of exponent {:g} is in {}^{:g}", exponent,
                             kind.is_angle ? "N m/rad" : "N/m", exponent),
                 fmt::format("write the plain number in that unit, or 'exponent: 1' for a stiffness in {}",
                             kind.is_angle ? "N m/rad" : "N/m"));
  return value.positive(kRatio);
}

Scene::CoordinateLimit read_joint_limit(int i, const Value& value, const JointCoordinateKind& kind) {
  const Mapping keys(value, {"lower", "upper", "stiffness", "exponent", "damping"});
  const CoordinateDimensions d = dimensions_of(kind, value);
  Scene::CoordinateLimit limit;
  limit.coordinate = i;
  if (const auto lower = keys.optional("lower")) limit.lower = lower->number(d.value);
  if (const auto upper = keys.optional("upper")) limit.upper = upper->number(d.value);
  if (!limit.lower && !limit.upper) value.refuse("there is no limit", "give 'lower', 'upper' or both");
  if (limit.lower && limit.upper && !(*limit.lower < *limit.upper))
    value.refuse("the lower limit is not below the upper one", "exchange them");
  if (const auto n = keys.optional("exponent")) limit.exponent = n->positive(kRatio);
  if (limit.exponent < 1) value.refuse("the exponent of a stop is below one", "give 1 to 3; 1.5 is usual");
  limit.stiffness = read_stop_stiffness(keys.required("stiffness"), limit.exponent, kind);
  const Dimension per_rate{"damping of a stop", kind.is_angle ? "s/rad" : "s/m"};
  if (const auto b = keys.optional("damping")) limit.damping = b->non_negative(per_rate);
  return limit;
}

}  // namespace

void read_joint_forces(const Mapping& keys, const JointKindInfo& kind, Scene::Joint& joint) {
  const auto each = [&](std::string_view key, auto read, auto& list) {
    if (const auto value = keys.optional(key))
      for_each_coordinate(
          *value, kind, [&](int i, const Value& own) { list.push_back(read(i, own, kind.coordinates[i])); });
  };
  each("spring", read_joint_spring, joint.springs);
  each("friction", read_joint_friction, joint.frictions);
  each("limits", read_joint_limit, joint.limits);
}

}  // namespace wishbone::scene_sections
