#include "solver/run_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <variant>

#include "core/units.h"
#include "joints/motion_jump.h"
#include "solver/inverse_dynamics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

/// Errors of single steps add up: what a run of many may lose of the energy it has exchanged, by its relative tolerance ...
constexpr double kStepsOfError = 1000;
/// ... and at most: a run that loses more is not to be trusted, however loose its tolerance.
constexpr double kMostDrift = 0.05;
constexpr double kRounding = 1e-12;
/// Closures are projected at every output; open by more, they are not closed [m, rad].
constexpr double kOpen = 1e-8;

/// A prescribed motion and the joint that follows it.
struct Driven {
  std::string name;
  const Motion* motion;
  bool is_angle;
};

std::vector<Driven> driven_joints(const System& system) {
  std::vector<Driven> all;
  for (const TreeBody& body : system.bodies)
    if (const auto* joint = std::get_if<PrescribedJoint>(&body.joint))
      all.push_back({body.joint_name, &joint->motion, joint->kind == PrescribedJoint::Kind::revolute});
  for (const Closure& closure : system.closures)
    if (const Motion* motion = drive(closure.joint))
      all.push_back({closure.name, motion, gauge(closure.joint, 0).is_angle()});
  return all;
}

std::string place(const Driven& driven, const MotionJump& jump) {
  return fmt::format("joint '{}' at t = {:.9g} s", driven.name, jump.time);
}

std::string from_to(const MotionJump& jump, const char* unit) {
  return fmt::format("from {:.6g} to {:.6g} {}", jump.before, jump.after, unit);
}

}  // namespace

Warnings check_prescribed_motions(const System& system, double duration, const IntegratorOptions& options) {
  Warnings warnings;
  for (const Driven& driven : driven_joints(system)) {
    const MotionJumps jumps = find_jumps(*driven.motion, duration, options.rtol, options.atol);
    if (jumps.position)
      throw InputError(
          {place(driven, *jumps.position), "the prescribed motion jumps",
           from_to(*jumps.position, driven.is_angle ? "rad" : "m"),
           "no body can follow: lead over within a short time, as step(t, t0, u0, t1, u1) does"});
    if (jumps.rate)
      warnings.push_back({place(driven, *jumps.rate),
                          "the speed of the prescribed motion jumps, which takes an infinite force",
                          from_to(*jumps.rate, driven.is_angle ? "rad/s" : "m/s"),
                          "forces and energies are wrong at this time: lead over within a short time"});
  }
  return warnings;
}

Warnings check_tires(const System& system, const State& state, Workspace& ws) {
  constexpr double kInTheAir = 1e-3;    // above the road [m]
  constexpr double kRolling = 1;        // speed from which a wheel has a way to go [m/s]
  constexpr double kAcross = 0.7071;    // sine of the angle between heading and way
  constexpr double kFastestTire = 100;  // [m/s]
  Warnings warnings;
  const std::vector<Tire>& tires = std::get<std::vector<Tire>>(system.forces);
  if (tires.empty()) return warnings;
  update_state<double>(system, state.t, state.q, state.v, state.x, ws);
  for_each_force(system, [&](const auto& element, int index) {
    if constexpr (std::is_same_v<std::decay_t<decltype(element)>, Tire>) {
      const Tire& tire = element;
      const MarkerState& wheel = ws.markers[static_cast<std::size_t>(tire.wheel())];
      const WheelContact c =
          wheel_contact(wheel, tire.parameters().radius, tire.road(), ws.memory.segments[index]);
      const double ahead = wheel.v_WM.dot(c.ux), sideways = wheel.v_WM.dot(c.uy);
      const double speed = std::hypot(ahead, sideways);
      const std::string where = fmt::format("tire '{}' at t = {:g} s", tire.name(), state.t);
      if (-c.deflection > kInTheAir)
        warnings.push_back({where, "the tire is in the air at the start",
                            fmt::format("{:.4g} m above the road", -c.deflection),
                            "lower the wheel or check the radius, unless it is meant to fall"});
      if (speed > kRolling && std::abs(sideways) > kAcross * speed)
        warnings.push_back(
            {where, "the wheel starts across the way that it goes",
             fmt::format("{:.3g} m/s ahead and {:.3g} m/s sideways", ahead, sideways),
             "the tire spins about the y axis of its body, which points to the left: turn the body"});
      if (speed > kFastestTire)
        warnings.push_back({where, "no tire is as fast",
                            fmt::format("{:.4g} m/s, which are {:.4g} km/h", speed, 3.6 * speed),
                            fmt::format("is the speed in km/h? write '{:.4g} km/h' then", speed)});
    }
  });
  return warnings;
}

double RunCheck::Books::size() const {
  return std::max({std::abs(kinetic), std::abs(gravity), std::abs(elastic), std::abs(loss), std::abs(input)});
}

void RunCheck::note_step(const State& state, const Workspace& ws) {
  largest_kinetic_ = std::max(largest_kinetic_, calc_energy(system_, state, ws).kinetic);
}

void RunCheck::observe(const State& state, const Work& work, Workspace& ws) {
  update_state<double>(system_, state.t, state.q, state.v, state.x, ws);
  const Energy energy = calc_energy(system_, state, ws);
  const Books books{energy.kinetic, energy.gravity, energy.elastic, work.loss, work.input};
  check_finite(state, books);
  note_books(state.t, books);
  note_closures(state.t, ws);
}

void RunCheck::check_finite(const State& state, const Books& books) const {
  const auto fail = [&](const std::string& what, double value) {
    throw NumericsError({fmt::format("t = {:.9g} s: {}", state.t, what), "this is not a finite number",
                         fmt::format("{}", value),
                         "look for extreme values in the forces and masses of the scene"});
  };
  for (int i = 0; i < system_.nv; ++i)
    if (!std::isfinite(state.v[i])) fail(system_.speed_name(i), state.v[i]);
  if (!state.q.allFinite()) fail("a coordinate", state.q.sum());
  if (!state.x.allFinite()) fail("a state of a force element", state.x.sum());
  if (!std::isfinite(books.balance())) fail("the energy", books.balance());
}

void RunCheck::note_books(double t, const Books& books) {
  largest_ = std::max(largest_, books.size());
  largest_kinetic_ = std::max(largest_kinetic_, books.kinetic);
  if (started_) {
    exchanged_ += std::abs(books.kinetic - last_.kinetic) + std::abs(books.gravity - last_.gravity) +
                  std::abs(books.elastic - last_.elastic) + std::abs(books.loss - last_.loss) +
                  std::abs(books.input - last_.input);
    drift_ = std::max(drift_, std::abs(books.balance() - first_.balance()));
    const double change = std::abs(books.balance() - last_.balance());
    if (change > worst_change_) {
      worst_change_ = change;
      t_before_change_ = t_last_;
      t_worst_change_ = t;
    }
  } else {
    first_ = books;
    started_ = true;
  }
  last_ = books;
  t_last_ = t;
}

void RunCheck::note_closures(double t, const Workspace& ws) {
  for (int row = 0; row < system_.n_rows; ++row) {
    if (!(std::abs(ws.Phi[row]) > gap_)) continue;
    gap_ = std::abs(ws.Phi[row]);
    t_gap_ = t;
    gap_row_ = row;
  }
}

/// rtol of what was exchanged and of the kinetic energy, atol as an error of position under weight and of speed, and rounding.
double RunCheck::energy_tolerance() const {
  const double mass = system_.total_mass();
  const double absolute =
      options_.atol * (mass * kStandardGravity + std::sqrt(2 * mass * largest_kinetic_) + mass);
  const double relative = std::min(kStepsOfError * options_.rtol, kMostDrift);
  return relative * (exchanged_ + largest_kinetic_) + kStepsOfError * absolute + kRounding * largest_;
}

Warnings RunCheck::warnings() const {
  Warnings warnings;
  const double tolerance = energy_tolerance();
  if (drift_ > tolerance)
    warnings.push_back(
        {fmt::format("energy, most of all from t = {:.6g} s to {:.6g} s", t_before_change_, t_worst_change_),
         "the energy balance has moved, by more than the tolerances of the run explain",
         fmt::format("{:.3g} J of {:.3g} J exchanged, {:.2g} J expected at most", drift_, exchanged_,
                     tolerance),
         "tighten analysis.rtol and atol; look for a force or motion that jumps at this time"});
  if (gap_ > std::max(kOpen, options_.atol))
    warnings.push_back({fmt::format("{} at t = {:.9g} s", system_.row_name(gap_row_), t_gap_),
                        "the joint is not closed", fmt::format("open by {:.3g} m or rad", gap_),
                        "look for joints out of line, or for a motion that the mechanism cannot follow"});
  return warnings;
}

}  // namespace wishbone
