#include "solver/first_order.h"

#include <fmt/format.h>

#include <cmath>

#include "core/units.h"
#include "solver/assembly.h"
#include "solver/closure_rank.h"
#include "solver/events.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/largest_force.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

constexpr int kMostFailures = 50;  // of evaluations at one time

State sized_state(const System& system) {
  return {0, VectorX::Zero(system.nq), VectorX::Zero(system.nv), VectorX::Zero(system.nx)};
}

/// Of a trial state: what exerts most has driven it beyond all bounds.
void require_finite_state(const System& system, const State& state, const Workspace& ws) {
  if (state.q.allFinite() && state.v.allFinite()) return;
  int i = 0;
  while (i < system.nv && std::isfinite(state.v[i])) ++i;
  throw NumericsError(
      {fmt::format("{} at t = {:.9g} s", i < system.nv ? system.speed_name(i) : "a coordinate", state.t),
       "this is not a finite number" + largest_force_text(system, state.t, state.x, ws), "",
       "look for extreme values in the forces that act there"});
}

}  // namespace

void require_finite(const System& system, double t, const Eigen::Ref<const VectorX>& x,
                    const Eigen::Ref<const VectorX>& rates, const Evaluation<double>& ev) {
  if (rates.allFinite()) return;
  const LargestForce force = find_largest_force(system, t, x, ev);
  if (!std::isfinite(force.magnitude))
    throw NumericsError({fmt::format("{} at t = {:.9g} s", force.name, t), "the force is not a finite number",
                         "", "look for extreme values in its parameters and in the motion of its markers"});
  Eigen::Index i = 0;
  while (std::isfinite(rates[i])) ++i;
  throw NumericsError({fmt::format("{} at t = {:.9g} s", system.speed_name(static_cast<int>(i)), t),
                       "the acceleration is not a finite number" + largest_force_text(system, t, x, ev),
                       fmt::format("{}", rates[i]),
                       "look for extreme values in the forces that act on this body"});
}

FirstOrderSystem::FirstOrderSystem(const System& system, Workspace& ws, ProgressGuard& guard)
    : FirstOrderSystem(system, ws, guard, system.nq + system.nv + system.nx + 2) {}

FirstOrderSystem::FirstOrderSystem(const System& system, Workspace& ws, ProgressGuard& guard,
                                   Eigen::Index size)
    : system_(system),
      ws_(ws),
      progress_(guard),
      size_(size),
      state_(sized_state(system)),
      weight_(system.total_mass() * kStandardGravity),
      needs_joint_forces_(has_prescribed_motion(system)) {}

void FirstOrderSystem::pack(const State& state, const Work& work, Eigen::Ref<VectorX> y) {
  y.head(system_.nq) = state.q;
  y.segment(system_.nq, system_.nv) = state.v;
  y.segment(system_.nq + system_.nv, system_.nx) = state.x;
  y[size_ - 2] = work.loss;
  y[size_ - 1] = work.input;
}

void FirstOrderSystem::unpack(double t, const Eigen::Ref<const VectorX>& y, State& state, Work& work) {
  state.t = t;
  state.q = y.head(system_.nq);
  state.v = y.segment(system_.nq, system_.nv);
  state.x = y.segment(system_.nq + system_.nv, system_.nx);
  work = {y[size_ - 2], y[size_ - 1]};
}

std::string FirstOrderSystem::largest_force() const {
  return largest_force_text(system_, state_.t, state_.x, ws_);
}

bool FirstOrderSystem::is_stuck() {
  const double t = state_.t;
  if (!(std::abs(t - t_stuck_) <= 1e-9 * std::abs(t))) {
    t_stuck_ = t;
    failures_ = 0;
  }
  return ++failures_ > kMostFailures;
}

Work FirstOrderSystem::calc_motion(const State& state) {
  require_finite_state(system_, state, ws_);
  calc_forward_dynamics(system_, state, ws_);
  require_finite(system_, state.t, state.x, ws_.v_rate, ws_);
  if (needs_joint_forces_) calc_joint_forces(system_, ws_);
  return calc_work_rate<double>(system_, state.t, ws_.lambda, ws_);
}

Tangents& FirstOrderSystem::tangents() {
  if (!tangents_) tangents_ = std::make_unique<Tangents>(system_);
  return *tangents_;
}

void FirstOrderSystem::calc_rate(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> y_rate) {
  unpack(t, y, state_, work_);
  // next to a singular position errors of the state grow without bound in the rates: these are taken on the closures
  if (near_singular(ws_)) {
    normalize_quaternions(system_, state_.q);
    wishbone::project(system_, kProjectionTolerance, state_, ws_);
  }
  const Work rate = calc_motion(state_);
  calc_q_rate<double>(system_, state_.q, state_.v, y_rate.data());
  y_rate.segment(system_.nq, system_.nv) = ws_.v_rate;
  y_rate.segment(system_.nq + system_.nv, system_.nx) = ws_.x_rate;
  y_rate.tail<2>() << rate.loss, rate.input;
}

void FirstOrderSystem::calc_jacobian(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<MatrixX> J) {
  const Eigen::Index nq = system_.nq, nv = system_.nv, nx = system_.nx, n = nq + nv + nx;
  unpack(t, y, state_, work_);
  calc_motion(state_);
  if (!directions_) {
    directions_ = std::make_unique<Directions>(system_, n);
    directions_->q.leftCols(nq).setIdentity();
    directions_->v.middleCols(nq, nv).setIdentity();
    directions_->x.rightCols(nx).setIdentity();
    derivatives_ = std::make_unique<MotionDerivatives>(system_, n);
  }
  tangents().calc(state_, *directions_, ws_, *derivatives_);
  J.setZero();  // nothing depends on the energies
  J.topLeftCorner(nq, n) = derivatives_->q_rate;
  J.block(nq, 0, nv, n) = derivatives_->v_rate;
  J.block(nq + nv, 0, nx, n) = derivatives_->x_rate;
  J.block(n, 0, 2, n) = derivatives_->work_rate;
}

bool FirstOrderSystem::project(double t, double tolerance, Eigen::Ref<VectorX> y, double implicit_step) {
  unpack(t, y, state_, work_);
  normalize_quaternions(system_, state_.q);
  if (!ws_.closure.kept.empty() && !wishbone::project(system_, tolerance, state_, ws_, implicit_step))
    return false;
  y.head(system_.nq) = state_.q;
  y.segment(system_.nq, system_.nv) = state_.v;
  return y.allFinite();  // next to a singular position the corrections may overflow
}

bool FirstOrderSystem::outlived() {
  return revise_rows(system_, state_, ws_) == RowRevision::grown;
}

void FirstOrderSystem::calc_events(double t, const Eigen::Ref<const VectorX>& y, double* g) {
  unpack(t, y, state_, work_);
  update_positions<double>(system_, t, state_.q, ws_);
  update_markers<double>(system_, ws_);
  wishbone::calc_events(system_, ws_, {g, static_cast<std::size_t>(event_count(system_))});
}

double FirstOrderSystem::jacobian_cost() const {
  const auto n = static_cast<double>(size_);
  return n / 2 +
         n * n / 200;  // estimated: half a rate for each direction of the derivatives, and the dense factors
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
