#include "solver/largest_force.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/error.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

double size_of(const std::vector<Wrench>& wrenches, const std::vector<double>& state_rates, double power) {
  bool finite = std::isfinite(power);
  double largest = 0;
  for (const Wrench& w : wrenches) {
    finite = finite && w.f.allFinite() && w.t.allFinite();
    largest = std::max({largest, w.f.stableNorm(), w.t.stableNorm()});
  }
  for (const double rate : state_rates) finite = finite && std::isfinite(rate);
  return finite ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

LargestForce find_largest_force(const System& system, double t, const VectorX& x,
                                const Evaluation<double>& ev) {
  LargestForce largest;
  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    const int n = element.state_count();
    std::vector<Wrench> wrenches(ev.markers.size());
    std::vector<double> rates(static_cast<std::size_t>(n));
    ForceOutput out{wrenches, rates, 0};
    element.apply(force_input(t, x, x_start, n, index, ev), out);
    x_start += n;
    const double size = size_of(wrenches, rates, out.power);
    if (largest.name.empty() || size > largest.magnitude) largest = {element.name(), size};
  });
  return largest;
}

namespace {

/// The prescribed motion with the largest acceleration, or nothing.
std::string fastest_motion_text(const System& system, double t) {
  std::string name;
  double fastest = 0;
  const auto look = [&](const std::string& joint, const Motion& motion) {
    const double acceleration = std::abs(motion.at(t).acceleration);
    if (!(acceleration > fastest)) return;
    fastest = acceleration;
    name = joint;
  };
  for (const TreeBody& body : system.bodies)
    if (const auto* joint = std::get_if<PrescribedJoint>(&body.joint)) look(body.joint_name, joint->motion);
  for (const Closure& closure : system.closures)
    if (const Motion* motion = drive(closure.joint)) look(closure.name, *motion);
  if (name.empty()) return "";
  return fmt::format("; the largest prescribed acceleration is that of '{}', {:.3g} m/s2 or rad/s2", name,
                     fastest);
}

}  // namespace

std::string largest_force_text(const System& system, double t, const VectorX& x,
                               const Evaluation<double>& ev) {
  try {
    const LargestForce largest = find_largest_force(system, t, x, ev);
    const std::string motion = fastest_motion_text(system, t);
    if (largest.name.empty()) return motion;
    return fmt::format("; the largest force there is that of '{}', {:.3g} N or N m{}", largest.name,
                       largest.magnitude, motion);
  } catch (const NumericsError& error) {
    return fmt::format("; {}: {}", error.diagnostic().where, error.diagnostic().what);
  }
}

}  // namespace wishbone
