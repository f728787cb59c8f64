#include "identification/formats/uff/uff_systems.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr int kCartesian = 0, kCylindrical = 1, kSpherical = 2;
constexpr double kDegree = std::numbers::pi / 180;

/// e_r, e_theta, e_z.
Matrix3 cylindrical_directions(double theta) {
  Matrix3 e;
  e << std::cos(theta), -std::sin(theta), 0, std::sin(theta), std::cos(theta), 0, 0, 0, 1;
  return e;
}

/// e_r, e_theta, e_phi.
Matrix3 spherical_directions(double theta, double phi) {
  Matrix3 e;
  e << std::sin(theta) * std::cos(phi), std::cos(theta) * std::cos(phi), -std::sin(phi),  //
      std::sin(theta) * std::sin(phi), std::cos(theta) * std::sin(phi), std::cos(phi),    //
      std::cos(theta), -std::sin(theta), 0;
  return e;
}

}  // namespace

Vector3 UffFrame::global(const Vector3& c) const {
  if (type == kCylindrical)
    return origin + axes * (c[0] * cylindrical_directions(c[1] * kDegree).col(0) + c[2] * Vector3::UnitZ());
  if (type == kSpherical)
    return origin + axes * (c[0] * spherical_directions(c[1] * kDegree, c[2] * kDegree).col(0));
  return origin + axes * c;
}

Matrix3 UffFrame::directions_at(const Vector3& point) const {
  if (type == kCartesian) return axes;
  const Vector3 p = axes.transpose() * (point - origin);
  const double rho = std::hypot(p.x(), p.y());
  const bool is_on_axis = !(rho > 1e-9 * p.norm());
  const double azimuth = is_on_axis ? 0 : std::atan2(p.y(), p.x());
  if (type == kCylindrical) return axes * cylindrical_directions(azimuth);
  return axes * spherical_directions(is_on_axis && p.z() == 0 ? 0 : std::atan2(rho, p.z()), azimuth);
}

UffSystems::UffSystems(const std::vector<UffCoordinateSystem>& systems, std::string where)
    : where_(std::move(where)) {
  for (const UffCoordinateSystem& system : systems) systems_.emplace(system.number, &system);
}

const UffFrame& UffSystems::frame(int number) {
  const auto refuse = [&](std::string what, int which, std::string remedy) {
    throw InputError(
        {where_, std::move(what), fmt::format("coordinate system {}", which), std::move(remedy)});
  };
  // the systems on the way to one whose frame is known, and back
  std::vector<const UffCoordinateSystem*> way;
  int next = number;
  while (!is_global(next) && !frames_.contains(next)) {
    const auto system = systems_.find(next);
    if (system == systems_.end())
      refuse("a coordinate system is referred to and not defined", next, "write it as dataset 18 or 2420");
    const int type = system->second->type;
    if (type < kCartesian || type > kSpherical)
      refuse(fmt::format("a coordinate system is of type {}, which there is none of", type), next,
             "write 0 (Cartesian), 1 (cylindrical) or 2 (spherical)");
    way.push_back(system->second);
    if (way.size() > systems_.size())
      refuse("coordinate systems refer to each other in a circle", next, "let one of them refer to 0");
    next = system->second->reference;
  }
  for (; !way.empty(); way.pop_back()) {
    const UffCoordinateSystem& system = *way.back();
    const UffFrame& base = frames_[system.reference];  // global ones are the identity
    if (base.type != kCartesian)
      refuse("a coordinate system refers to one that is not Cartesian", system.number,
             "define it in a Cartesian one, or in global axes (reference 0)");
    const UffFrame frame = {base.origin + base.axes * system.origin, base.axes * system.axes, system.type};
    frames_[system.number] = frame;
  }
  return frames_[number];
}

Vector3 UffSystems::position(const UffNode& node) {
  return frame(node.definition_system).global(node.position);
}

}  // namespace wishbone
