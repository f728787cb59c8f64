#include "solver/system.h"

#include <utility>

#include "core/distinct_times.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

std::string speed_component(const TreeBody& body, int i) {
  static constexpr const char* kNames[] = {"wx", "wy", "wz", "vx", "vy", "vz"};
  if (body.nv == 1) return "speed";
  return body.nq == body.nv ? "speed " + std::to_string(i + 1) : kNames[i];
}

}  // namespace

double System::total_mass() const {
  double mass = 0;
  for (const TreeBody& body : bodies)
    mass += body.flexible < 0 ? body.mass : flexible[body.flexible].modal.mass();
  return mass;
}

std::string System::speed_name(int v_index) const {
  for (const FlexibleBody& f : flexible)
    if (v_index >= f.z_rate_start && v_index < f.z_rate_start + f.modal.mode_count())
      return bodies[f.body].name + ": elastic mode " + std::to_string(v_index - f.z_rate_start + 1);
  for (const TreeBody& body : bodies)
    if (v_index >= body.v_start && v_index < body.v_start + body.nv)
      return body.joint_name + ": " + speed_component(body, v_index - body.v_start);
  return "state " + std::to_string(v_index);
}

std::string System::row_name(int row) const {
  for (const Closure& closure : closures)
    if (row >= closure.row_start && row < closure.row_start + closure.rows)
      return closure.name + " (" + row_direction(closure.joint, row - closure.row_start) + ")";
  return "row " + std::to_string(row);
}

std::vector<double> System::stop_times() const {
  std::vector<double> times;
  const auto add = [&](const auto& element) {
    const std::vector<double> t = element.stop_times();
    times.insert(times.end(), t.begin(), t.end());
  };
  for (const TreeBody& body : bodies)
    if (const auto* joint = std::get_if<PrescribedJoint>(&body.joint)) add(joint->motion);
  for (const Closure& closure : closures)
    if (const Motion* motion = drive(closure.joint)) add(*motion);
  for_each_force(*this, [&](const auto& element, int) {
    if constexpr (requires { element.stop_times(); }) add(element);
  });
  return distinct_times(std::move(times));
}

}  // namespace wishbone
