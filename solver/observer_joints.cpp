#include "joints/joint_kind.h"
#include "solver/closures.h"
#include "solver/interface.h"
#include "solver/observation.h"
#include "solver/observer.h"
#include "solver/reactions.h"

namespace wishbone {

using namespace observation;

namespace {

struct Units {
  const char* coordinate;
  const char* speed;
};

constexpr const char* kDrivingForce =
    "force or moment that the motion needs, along its coordinate; positive lets it grow";

Units scalar_units(const TreeBody& body) {
  const auto* prescribed = std::get_if<PrescribedJoint>(&body.joint);
  const bool slides = std::holds_alternative<PrismaticJoint>(body.joint) ||
                      (prescribed != nullptr && prescribed->kind == PrescribedJoint::Kind::prismatic);
  return slides ? Units{"m", "m/s"} : Units{"rad", "rad/s"};
}

}  // namespace

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
    // as of a motion that a row drives
    add(path + "_drive/force", {3}, "N", kWorld, "of the motion on the first-named body, at the joint",
        [i](const Sample& s, double* out) {
          put(linear(tree_joint_drive(s.system, s.ws, static_cast<int>(i))), out);
        });
    add(path + "_drive/moment", {3}, "N m", kWorld, "of the motion on the first-named body, about the joint",
        [i](const Sample& s, double* out) {
          put(angular(tree_joint_drive(s.system, s.ws, static_cast<int>(i))), out);
        });
    add(path + "_drive/driving_force", {}, scalar_units(body).coordinate[0] == 'm' ? "N" : "N m", "",
        kDrivingForce, [i](const Sample& s, double* out) {
          *out = tree_joint_driving_force(s.system, s.ws, static_cast<int>(i));
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
    if (!is_driven(system.closures[c].joint)) continue;
    // one row, whose multiplier is the force along the coordinate
    const int row = system.closures[c].row_start;
    add(path + "/driving_force", {}, row_is_angle(system.closures[c].joint, 0) ? "N m" : "N", "",
        kDrivingForce, [row](const Sample& s, double* out) { *out = s.ws.lambda[row]; });
  }
}

}  // namespace wishbone
