#include "solver/observer.h"

#include <algorithm>
#include <cmath>

#include "joints/joint_kind.h"
#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/loads.h"
#include "solver/reactions.h"

namespace wishbone {
namespace {

constexpr const char* kWorld = "world";

void put(const Vector3& a, double* out) {
  Eigen::Map<Vector3>{out} = a;
}

/// World components of the joint's own frame F.
Matrix3 inboard_rotation(const TreeBody& body, const Workspace& ws) {
  return body.parent < 0 ? body.X_PF.R : Matrix3(ws.bodies[body.parent].X_WB.R * body.X_PF.R);
}

struct JointMotion {
  double position = 0, rate = 0;
};

/// Coordinate and speed of a joint with one freedom or with a prescribed motion.
JointMotion scalar_motion(const TreeBody& body, const State& state) {
  if (const auto* prescribed = std::get_if<PrescribedJoint>(&body.joint)) {
    const MotionValue u = prescribed->motion.at(state.t);
    return {u.position, u.rate};
  }
  return {state.q[body.q_start], state.v[body.v_start]};
}

struct Units {
  const char* coordinate;
  const char* speed;
};
Units scalar_units(const TreeBody& body) {
  const auto* prescribed = std::get_if<PrescribedJoint>(&body.joint);
  const bool slides = std::holds_alternative<PrismaticJoint>(body.joint) ||
                      (prescribed != nullptr && prescribed->kind == PrescribedJoint::Kind::prismatic);
  return slides ? Units{"m", "m/s"} : Units{"rad", "rad/s"};
}

}  // namespace

Observer::Observer(const System& system, const ObserverOptions& options) : system_(system) {
  add_bodies(system);
  add_flexible(system, options);
  add_tree_joints(system);
  add_measured(system);
  add_closures(system);
  add_forces(system);
  if (options.chassis >= 0) add_vehicle(options);
  add_energy();
  add_constraints(system);
  std::size_t size = 0;
  for (const Signal& signal : signals_) size += signal.size();
  row_.assign(size, 0.0);
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

void Observer::add_flexible(const System& system, const ObserverOptions& options) {
  for (std::size_t k = 0; k < system.flexible.size(); ++k) {
    const FlexibleBody& flexible = system.flexible[k];
    const int start = flexible.z_start, m = flexible.modal.mode_count();
    add("/flexible/" + system.bodies[flexible.body].name + "/modal_coordinates", {m}, "m kg^0.5", "",
        "amplitudes of the mass-normalised elastic modes", [start, m](const Sample& s, double* out) {
          Eigen::Map<VectorX>(out, m) = s.state.q.segment(start, m);
        });
  }
  for (const ObserverOptions::Deflection& d : options.deflections) {
    const TreeBody& body = system.bodies[d.body];
    if (body.flexible < 0) continue;
    const int k = body.flexible;
    add("/flexible/" + body.name + "/deflection", {static_cast<int>(d.node_ids.size()), 3}, "m", "body",
        "deflection of nodes from the undeformed body, mean-axis frame",
        [k, ids = d.node_ids](const Sample& s, double* out) {
          for (const int id : ids) {
            put(s.system.flexible[k].modal.deflection(id, s.ws.flexible[k].modal), out);
            out += 3;
          }
        });
    for (const int id : d.node_ids) signals_.back().lists["nodes"].push_back(std::to_string(id));
  }
}

void Observer::add_tree_joints(const System& system) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    if (body.floating) continue;
    const std::string path = "/joints/" + body.joint_name;
    const bool prescribed = std::holds_alternative<PrescribedJoint>(body.joint);
    if (prescribed || body.nv == 1) {
      const Units units = scalar_units(body);
      add(path + "/coordinates", {}, units.coordinate, "", "joint coordinate",
          [i](const Sample& s, double* out) { *out = scalar_motion(s.system.bodies[i], s.state).position; });
      add(path + "/speeds", {}, units.speed, "", "joint speed",
          [i](const Sample& s, double* out) { *out = scalar_motion(s.system.bodies[i], s.state).rate; });
    } else if (body.nv > 1 && body.nq == body.nv) {
      const JointKindInfo& kind = *find_info(joint_kind(body.joint));
      for (std::size_t k = 0; k < kind.coordinates.size(); ++k) {
        const std::string name(kind.coordinates[k].name);
        const bool angle = kind.coordinates[k].is_angle;
        add(path + "/" + name, {}, angle ? "rad" : "m", "", "joint coordinate",
            [q = body.q_start + k](const Sample& s, double* out) { *out = s.state.q[q]; });
        add(path + "/" + name + "_rate", {}, angle ? "rad/s" : "m/s", "", "joint speed",
            [v = body.v_start + k](const Sample& s, double* out) { *out = s.state.v[v]; });
      }
    } else if (body.nv > 1) {
      add_rotation(path, body);
      if (body.nv == 6) add_translation(path, body);
    }
    add(path + "/force", {3}, "N", kWorld, "reaction on the first-named body, at the joint",
        [i](const Sample& s, double* out) {
          put(linear(tree_joint_reaction(s.system, s.ws, static_cast<int>(i))), out);
        });
    add(path + "/moment", {3}, "N m", kWorld, "reaction moment on the first-named body, about the joint",
        [i](const Sample& s, double* out) {
          put(angular(tree_joint_reaction(s.system, s.ws, static_cast<int>(i))), out);
        });
    if (!prescribed) continue;
    add(path + "/driving_force", {}, scalar_units(body).coordinate[0] == 'm' ? "N" : "N m", "",
        "force or moment that the prescribed motion needs, along the axis, on the second-named body",
        [i](const Sample& s, double* out) {
          const TreeBody& b = s.system.bodies[i];
          const auto& joint = std::get<PrescribedJoint>(b.joint);
          const Vector3 axis = (b.first_is_child ? -1.0 : 1.0) * (inboard_rotation(b, s.ws) * joint.axis_F);
          const Vector6 F = -tree_joint_reaction(s.system, s.ws, static_cast<int>(i));
          *out = axis.dot(joint.kind == PrescribedJoint::Kind::revolute ? Vector3(angular(F))
                                                                        : Vector3(linear(F)));
        });
  }
}

void Observer::add_rotation(const std::string& path, const TreeBody& body) {
  add(path + "/orientation", {4}, "1", "second-named body to first-named body",
      "unit quaternion w x y z of the relative rotation, the identity in the design pose",
      [q = body.q_start](const Sample& s, double* out) {
        Eigen::Map<Eigen::Vector4d>{out} = s.state.q.segment<4>(q);
      });
  add(path + "/angular_velocity", {3}, "rad/s", "second-named body", "relative angular velocity",
      [v = body.v_start](const Sample& s, double* out) { put(s.state.v.segment<3>(v), out); });
}

void Observer::add_translation(const std::string& path, const TreeBody& body) {
  add(path + "/position", {3}, "m", "first-named body", "origin of the second-named body",
      [q = body.q_start](const Sample& s, double* out) { put(s.state.q.segment<3>(q + 4), out); });
  add(path + "/velocity", {3}, "m/s", "first-named body", "velocity seen from the first-named body",
      [v = body.v_start](const Sample& s, double* out) { put(s.state.v.segment<3>(v + 3), out); });
}

void Observer::add_measured(const System& system) {
  for (std::size_t i = 0; i < system.measured.size(); ++i) {
    const MeasuredCoordinate& c = system.measured[i];
    const std::string path = "/joints/" + c.joint + "/";
    const bool angle = c.gauge.is_angle();
    add(path + (c.name.empty() ? "coordinates" : c.name), {}, angle ? "rad" : "m", "", "joint coordinate",
        [i](const Sample& s, double* out) {
          const MeasuredCoordinate& m = s.system.measured[i];
          *out = m.gauge.value(s.ws.markers[m.A], s.ws.markers[m.B], s.ws.memory.measured_angles[i]);
        });
    add(path + (c.name.empty() ? "speeds" : c.name + "_rate"), {}, angle ? "rad/s" : "m/s", "", "joint speed",
        [i](const Sample& s, double* out) {
          const MeasuredCoordinate& m = s.system.measured[i];
          *out = m.gauge.rate(s.ws.markers[m.A], s.ws.markers[m.B]);
        });
  }
}

void Observer::add_closures(const System& system) {
  for (std::size_t c = 0; c < system.closures.size(); ++c) {
    const std::string path = "/joints/" + system.closures[c].name;
    const auto reaction = [c](const Sample& s) -> Vector6 {
      return closure_wrench(s.system.closures[c], 0, s.ws.lambda, s.ws);
    };
    add(path + "/force", {3}, "N", kWorld,
        "reaction on the first-named body, at the joint; of least norm where the mechanism is "
        "over-constrained",
        [reaction](const Sample& s, double* out) { put(linear(reaction(s)), out); });
    add(path + "/moment", {3}, "N m", kWorld, "reaction moment on the first-named body, about the joint",
        [reaction](const Sample& s, double* out) { put(angular(reaction(s)), out); });
  }
}

void Observer::add_forces(const System& system) {
  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    using Element = std::decay_t<decltype(element)>;
    const int states = element.state_count();
    const auto input = [=](const Sample& s) {
      return force_input(s.state.t, s.state.x, x_start, states, index, s.ws);
    };
    if constexpr (std::is_same_v<Element, SpringDamper>) {
      const std::string path = "/forces/" + element.name();
      add(path + "/length", {}, "m", "", "distance of the end points",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).length; });
      add(path + "/rate", {}, "m/s", "", "rate of change of the length",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).rate; });
      add(path + "/force", {}, "N", "", "force, positive in tension",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).force; });
    } else if constexpr (requires { element.gauge(); }) {
      const bool angle = element.gauge().is_angle();
      const std::string path = "/forces/" + element.name();
      add(path + "/value", {}, angle ? "rad" : "m", "", "joint coordinate",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).value; });
      add(path + "/force", {}, angle ? "N m" : "N", "", "along the coordinate, positive lets it grow",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).force; });
    } else if constexpr (std::is_same_v<Element, Tire>) {
      const std::string path = "/tires/" + element.name();
      add(path + "/force", {3}, "N", "contact axes ux uy uz", "on the wheel, at the contact point",
          [input, &element](const Sample& s, double* out) { put(element.output(input(s)).force, out); });
      add(path + "/moment", {3}, "N m", "contact axes ux uy uz", "on the wheel, about the contact point",
          [input, &element](const Sample& s, double* out) { put(element.output(input(s)).moment, out); });
      add(path + "/slip_ratio", {}, "1", "", "positive when braking",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).slip_ratio; });
      add(path + "/slip_angle", {}, "rad", "", "positive when the wheel slips to its left",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).slip_angle; });
      add(path + "/camber", {}, "rad", "", "positive when the top leans to the left",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).camber; });
      add(path + "/deflection", {}, "m", "", "radial deflection, negative in the air",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).deflection; });
    }
    x_start += states;
  });
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
