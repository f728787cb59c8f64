#include "solver/observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/glob.h"
#include "solver/forward_dynamics.h"
#include "solver/observation.h"
#include "solver/reactions.h"

namespace wishbone {

using namespace observation;

Observer::Observer(const System& system, const ObserverOptions& options) : system_(system) {
  add_bodies(system);
  add_flexible(system, options);
  add_tree_joints(system);
  add_measured(system);
  add_closures(system);
  add_forces(system);
  add_signals(options);
  add_points(options);
  if (options.chassis >= 0) add_vehicle(options);
  add_energy();
  add_constraints(system);
  size_row();
}

void Observer::size_row() {
  std::size_t size = 0;
  for (const Signal& signal : signals_) size += signal.size();
  row_.assign(size, 0.0);
}

std::vector<std::string> Observer::keep(const std::vector<std::string>& patterns) {
  if (patterns.empty()) return {};
  std::vector<std::string> unmatched;
  for (const std::string& pattern : patterns)
    if (std::ranges::none_of(signals_, [&](const Signal& s) { return matches(pattern, s.path); }))
      unmatched.push_back(pattern);
  if (unmatched.size() == patterns.size())
    throw InputError(
        {"output.record", "no signal matches", unmatched.front(),
         "the paths of signals are listed in docs/results.md, and by `wishbone info` of a results file"});
  std::size_t kept = 0;
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    if (!matches_any(patterns, signals_[i].path)) continue;
    std::swap(signals_[kept], signals_[i]);
    std::swap(evaluators_[kept++], evaluators_[i]);
  }
  signals_.resize(kept);
  evaluators_.resize(kept);
  size_row();
  return unmatched;
}

std::span<const double> Observer::sample(const State& state, const Work& work, Workspace& ws) {
  calc_forward_dynamics(system_, state, ws);
  calc_reactions(system_, ws);
  Sample sample{system_, state, ws, calc_energy(system_, state, ws)};
  if (!started_) springs_at_start_ = sample.energy.springs;
  started_ = true;
  // the force elements have taken `loss` out of the bodies; what they still store is not dissipated
  sample.dissipated = work.loss - (sample.energy.springs - springs_at_start_);
  sample.input = work.input;
  double* out = row_.data();
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    evaluators_[i](sample, out);
    out += signals_[i].size();
  }
  return row_;
}

void Observer::add(std::string path, std::vector<int> shape, std::string units, std::string frame,
                   std::string about, Evaluate evaluate) {
  signals_.push_back(
      {std::move(path), std::move(shape), std::move(units), std::move(frame), std::move(about), {}});
  evaluators_.push_back(std::move(evaluate));
}

void Observer::add_bodies(const System& system) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const std::string path = "/bodies/" + system.bodies[i].name;
    add(path + "/position", {3}, "m", kWorld, "position of the body origin (mass centre)",
        [i](const Sample& s, double* out) { put(s.ws.bodies[i].X_WB.p, out); });
    add(path + "/velocity", {3}, "m/s", kWorld, "velocity of the body origin",
        [i](const Sample& s, double* out) { put(linear(s.ws.bodies[i].V), out); });
    add(path + "/orientation", {4}, "1", "body to world", "unit quaternion w x y z, w >= 0",
        [i](const Sample& s, double* out) {
          Quaternion Q(s.ws.bodies[i].X_WB.R);
          const double sign = Q.w() < 0 ? -1.0 : 1.0;
          Eigen::Map<Eigen::Vector4d>{out} = sign * Eigen::Vector4d(Q.w(), Q.x(), Q.y(), Q.z());
        });
    add(path + "/angular_velocity", {3}, "rad/s", "body", "angular velocity",
        [i](const Sample& s, double* out) {
          put(s.ws.bodies[i].X_WB.R.transpose() * angular(s.ws.bodies[i].V), out);
        });
  }
}

void Observer::add_signals(const ObserverOptions& options) {
  for (std::size_t i = 0; i < options.signals.size(); ++i) {
    const ObserverOptions::NamedSignal& signal = options.signals[i];
    add("/signals/" + signal.name, {}, signal.units, "", "signal that functions of loads may use",
        [variable = i + 1](const Sample& s, double* out) { *out = s.ws.variables[variable]; });
  }
}

void Observer::add_points(const ObserverOptions& options) {
  for (const ObserverOptions::Point& point : options.points) {
    const std::string path = "/points/" + point.name;
    const auto motion = [on = point.point](const Sample& s) { return calc_point_motion(s.system, on, s.ws); };
    add(path + "/position", {3}, "m", kWorld, "position of the point",
        [motion](const Sample& s, double* out) { put(motion(s).p_WQ, out); });
    add(path + "/velocity", {3}, "m/s", kWorld, "velocity of the point",
        [motion](const Sample& s, double* out) { put(motion(s).v_WQ, out); });
    add(path + "/acceleration", {3}, "m/s2", kWorld, "acceleration of the point",
        [motion](const Sample& s, double* out) { put(motion(s).a_WQ, out); });
  }
}

void Observer::add_vehicle(const ObserverOptions& options) {
  const int chassis = options.chassis;
  const auto state = [chassis](const Sample& s) -> const BodyMotion& { return s.ws.bodies[chassis]; };
  const auto v_B = [state](const Sample& s) -> Vector3 {
    return state(s).X_WB.R.transpose() * linear(state(s).V);
  };
  const auto w_B = [state](const Sample& s) -> Vector3 {
    return state(s).X_WB.R.transpose() * angular(state(s).V);
  };
  add("/vehicle/lateral_position", {}, "m", "", "y of the chassis origin, positive to the left",
      [state](const Sample& s, double* out) { *out = state(s).X_WB.p.y(); });
  add("/vehicle/vertical_position", {}, "m", "", "z of the chassis origin",
      [state](const Sample& s, double* out) { *out = state(s).X_WB.p.z(); });
  add("/vehicle/lateral_velocity", {}, "m/s", "", "velocity of the chassis origin along the chassis y axis",
      [v_B](const Sample& s, double* out) { *out = v_B(s).y(); });
  add("/vehicle/side_slip", {}, "rad", "",
      "atan2(vy, vx) in chassis components, positive when drifting to the left",
      [v_B](const Sample& s, double* out) { *out = std::atan2(v_B(s).y(), v_B(s).x()); });
  add("/vehicle/roll_rate", {}, "rad/s", "", "angular velocity about the chassis x axis",
      [w_B](const Sample& s, double* out) { *out = w_B(s).x(); });
  add("/vehicle/yaw_rate", {}, "rad/s", "", "angular velocity about the chassis z axis",
      [w_B](const Sample& s, double* out) { *out = w_B(s).z(); });
  for (const ObserverOptions::Steering& steering : options.steering) {
    const int i = steering.body;
    add("/vehicle/steering_" + steering.name, {}, "rad", "", "steering angle, positive to the left",
        [i, sign = steering.sign](const Sample& s, double* out) {
          *out = sign * scalar_motion(s.system.bodies[i], s.state).position;
        });
  }
}

void Observer::add_energy() {
  add("/energy/kinetic", {}, "J", "", "kinetic energy of all bodies",
      [](const Sample& s, double* out) { *out = s.energy.kinetic; });
  add("/energy/gravity", {}, "J", "", "potential energy of weight, zero at the inertial origin",
      [](const Sample& s, double* out) { *out = s.energy.gravity; });
  add("/energy/elastic", {}, "J", "", "strain energy of the flexible bodies",
      [](const Sample& s, double* out) { *out = s.energy.elastic; });
  add("/energy/springs", {}, "J", "", "energy stored in springs and tires",
      [](const Sample& s, double* out) { *out = s.energy.springs; });
  add("/energy/dissipated", {}, "J", "",
      "energy lost in dampers, tires and structural damping since the start",
      [](const Sample& s, double* out) { *out = s.dissipated; });
  add("/energy/input", {}, "J", "", "energy brought in by loads and prescribed motions since the start",
      [](const Sample& s, double* out) { *out = s.input; });
  add("/energy/balance", {}, "J", "", "sum of the stored energies, plus dissipated, minus input: a constant",
      [](const Sample& s, double* out) {
        *out = s.energy.kinetic + s.energy.gravity + s.energy.elastic + s.energy.springs + s.dissipated -
               s.input;
      });
}

void Observer::add_constraints(const System& system) {
  if (system.n_rows == 0) return;
  const auto largest = [](const System& of, const VectorX& r, bool angles) {
    double worst = 0;
    for (const Closure& closure : of.closures)
      for (int i = 0; i < closure.rows; ++i)
        if (row_is_angle(closure.joint, i) == angles)
          worst = std::max(worst, std::abs(r[closure.row_start + i]));
    return worst;
  };
  add("/constraints/position_residual", {}, "m", "", "largest gap of a cut joint",
      [largest](const Sample& s, double* out) { *out = largest(s.system, s.ws.Phi, false); });
  add("/constraints/velocity_residual", {}, "m/s", "", "largest rate of a gap of a cut joint",
      [largest](const Sample& s, double* out) { *out = largest(s.system, s.ws.Phi_rate, false); });
  const bool angles = std::any_of(system.closures.begin(), system.closures.end(),
                                  [](const Closure& c) { return row_is_angle(c.joint, c.rows - 1); });
  if (!angles) return;
  add("/constraints/angle_residual", {}, "rad", "", "largest misalignment of a cut joint",
      [largest](const Sample& s, double* out) { *out = largest(s.system, s.ws.Phi, true); });
  add("/constraints/angular_velocity_residual", {}, "rad/s", "",
      "largest rate of a misalignment of a cut joint",
      [largest](const Sample& s, double* out) { *out = largest(s.system, s.ws.Phi_rate, true); });
}

}  // namespace wishbone
