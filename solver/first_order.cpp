#include "solver/first_order.h"

#include <fmt/format.h>

#include <cmath>

#include "solver/assembly.h"
#include "solver/events.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

constexpr double kStandardGravity = 9.80665;  // [m/s^2]

State sized_state(const System& system) {
  return {0, VectorX::Zero(system.nq), VectorX::Zero(system.nv), VectorX::Zero(system.nx)};
}

}  // namespace

void require_finite(const System& system, double t, const Eigen::Ref<const VectorX>& rates,
                    const Workspace& ws) {
  if (rates.allFinite()) return;
  for_each_force(system, [&](const auto& element, int index) {
    if (std::isfinite(ws.element_powers[index])) return;
    throw NumericsError({fmt::format("{} at t = {:.9g} s", element.name(), t),
                         "the force is not a finite number", "",
                         "look for extreme values in its parameters and in the motion of its markers"});
  });
  Eigen::Index i = 0;
  while (std::isfinite(rates[i])) ++i;
  throw NumericsError({fmt::format("{} at t = {:.9g} s", system.speed_name(static_cast<int>(i)), t),
                       "the acceleration is not a finite number", fmt::format("{}", rates[i]),
                       "look for extreme values in the forces that act on this body"});
}

FirstOrderSystem::FirstOrderSystem(const System& system, Workspace& ws)
    : system_(system),
      ws_(ws),
      size_(system.nq + system.nv + system.nx + 2),
      weight_(system.total_mass() * kStandardGravity),
      state_(sized_state(system)),
      q_rate_(VectorX::Zero(system.nq)) {}

void FirstOrderSystem::pack(const State& state, const Work& work, Eigen::Ref<VectorX> y) const {
  y.head(system_.nq) = state.q;
  y.segment(system_.nq, system_.nv) = state.v;
  y.segment(system_.nq + system_.nv, system_.nx) = state.x;
  y[size_ - 2] = work.loss;
  y[size_ - 1] = work.input;
}

void FirstOrderSystem::unpack(double t, const Eigen::Ref<const VectorX>& y, State& state, Work& work) const {
  state.t = t;
  state.q = y.head(system_.nq);
  state.v = y.segment(system_.nq, system_.nv);
  state.x = y.segment(system_.nq + system_.nv, system_.nx);
  work = {y[size_ - 2], y[size_ - 1]};
}

void FirstOrderSystem::calc_rate(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> y_rate) {
  unpack(t, y, state_, work_);
  calc_forward_dynamics(system_, state_, ws_);
  require_finite(system_, t, ws_.v_rate, ws_);
  calc_joint_forces(system_, ws_);
  calc_q_rate(system_, state_.q, state_.v, q_rate_);
  y_rate.head(system_.nq) = q_rate_;
  y_rate.segment(system_.nq, system_.nv) = ws_.v_rate;
  y_rate.segment(system_.nq + system_.nv, system_.nx) = ws_.x_rate;
  const Work rate = calc_work_rate(system_, t, ws_);
  y_rate[size_ - 2] = rate.loss;
  y_rate[size_ - 1] = rate.input;
}

bool FirstOrderSystem::project(double t, double tolerance, Eigen::Ref<VectorX> y) {
  unpack(t, y, state_, work_);
  normalize_quaternions(system_, state_.q);
  if (!ws_.kept.empty()) {
    if (project_positions(system_, tolerance, state_, ws_) < 0) return false;
    project_velocities(system_, state_, ws_);
  }
  pack(state_, work_, y);
  return y.allFinite();  // next to a singular position the corrections may overflow
}

void FirstOrderSystem::calc_events(double t, const Eigen::Ref<const VectorX>& y, double* g) {
  unpack(t, y, state_, work_);
  update_positions(system_, t, state_.q, ws_);
  update_markers(system_, ws_);
  wishbone::calc_events(system_, ws_, {g, static_cast<std::size_t>(event_count(system_))});
}

double FirstOrderSystem::tolerance_scale() const {
  return 1.0 / std::sqrt(static_cast<double>(size_));
}

void FirstOrderSystem::set_tolerances(double atol, Eigen::Ref<VectorX> tolerances) const {
  tolerances.setConstant(tolerance_scale() * atol);
  tolerances.tail<2>() *= weight_;
}

std::string FirstOrderSystem::name(Eigen::Index i) const {
  if (i < system_.nq) {
    for (const TreeBody& body : system_.bodies)
      if (i >= body.q_start && i < body.q_start + body.nq)
        return body.joint_name + ": coordinate " + std::to_string(i - body.q_start + 1);
    for (const FlexibleBody& body : system_.flexible)
      if (i >= body.z_start && i < body.z_start + body.modal.mode_count())
        return system_.bodies[body.body].name + ": amplitude of elastic mode " +
               std::to_string(i - body.z_start + 1);
  }
  i -= system_.nq;
  if (i < system_.nv) return system_.speed_name(static_cast<int>(i));
  i -= system_.nv;
  if (i < system_.nx) return "state " + std::to_string(i + 1) + " of the force elements";
  return i - system_.nx == 0 ? "energy lost" : "energy input";
}

}  // namespace wishbone
