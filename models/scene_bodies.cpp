#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/mode_set.h"
#include "models/identification_sections.h"
#include "models/scene_doubts.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

/// `modes: none`: the body is rigid, its mass and inertia those of its nodes.
void make_rigid(Scene::Body& body) {
  const VectorX mass = node_masses(*body.flexible);
  body.form = Scene::BodyForm::kRigid;
  body.mass = mass.sum();
  body.inertia = point_mass_inertia(mass, body.flexible->node_position);
}

Scene::Body read_body_keys(const std::string& name, const Value& value, Scene& scene) {
  const Mapping keys(value, {"mass", "inertia", "position", "orientation", "velocity", "angular_velocity",
                             "form", "flexible"});
  Scene::Body body;
  body.name = name;
  body.where = value.where();
  if (const auto form = keys.optional("form")) {
    body.form = form->choice<Scene::BodyForm>({{"rigid", Scene::BodyForm::kRigid},
                                               {"modal", Scene::BodyForm::kModal},
                                               {"nodal", Scene::BodyForm::kNodal}},
                                              "the forms of a body");
  }
  if (const auto flexible = keys.optional("flexible")) body.flexible = read_flexible(*flexible, scene);
  if (body.is_flexible() && !body.flexible) {
    keys.refuse(fmt::format("a {} body needs the key 'flexible'",
                            body.form == Scene::BodyForm::kModal ? "modal" : "nodal"),
                "add 'flexible: {block: ..., material: ..., modes: ...}'");
  }
  if (body.form == Scene::BodyForm::kModal && body.flexible->fixed_axes) {
    keys.refuse("the axes of a modal body are mean axes, for its modes are those of the free body",
                "write 'form: nodal', or remove 'axes'");
  }
  if (!body.is_flexible() || keys.has("mass")) body.mass = keys.required("mass").positive(kMass);
  if (!body.is_flexible() || keys.has("inertia")) body.inertia = read_inertia(keys.required("inertia"));
  if (body.is_flexible() && body.flexible->is_rigid) make_rigid(body);

  body.X_DB.p = keys.required("position").vector3(kLength);
  if (const auto orientation = keys.optional("orientation")) {
    const Mapping turn(*orientation, {"axis", "angle"});
    body.X_DB.R = read_rotation(turn.required("axis"), turn.required("angle"));
    doubt_angle(turn.required("angle"), scene.warnings);
  }
  if (const auto velocity = keys.optional("velocity")) body.v_WBo = velocity->vector3(kVelocity);
  if (const auto rate = keys.optional("angular_velocity")) body.w_WB_B = rate->vector3(kAngularVelocity);
  return body;
}

}  // namespace

Matrix3 read_rotation(const Value& axis, const Value& angle) {
  return quaternion_from_rotation_vector(angle.number(kAngle) * axis.direction()).toRotationMatrix();
}

Matrix3 read_inertia(const Value& value) {
  const std::vector<Value> items = value.list();
  if (items.size() != 3 && items.size() != 6) {
    value.refuse("the inertia must have three or six components",
                 "write [Jxx, Jyy, Jzz] or [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz]");
  }
  Vector6 J = Vector6::Zero();
  for (std::size_t i = 0; i < items.size(); ++i) J[static_cast<Eigen::Index>(i)] = items[i].number(kInertia);
  Matrix3 inertia;
  inertia << J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2];

  const Vector3 principal =
      Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string shown = fmt::format("its principal values are {:.6g}, {:.6g}, {:.6g} kg m2", principal[0],
                                        principal[1], principal[2]);
  // point masses and thin rods reach zero, up to rounding
  constexpr double kRounding = 1e-9;
  if (!(principal[0] >= -kRounding * std::abs(principal[2]))) {
    value.refuse("the inertia must not be negative: " + shown, "check the signs of the products of inertia");
  }
  // J1 + J2 - J3 = 2 integral x3^2 dm >= 0; flat bodies reach zero, up to rounding
  if (principal[0] + principal[1] < (1 - kRounding) * principal[2]) {
    value.refuse("no body can have this inertia: " + shown,
                 "the largest must not exceed the sum of the two others");
  }
  return inertia;
}

Vector3 node_place(const Scene::Body& body, int node) {
  const std::vector<int>& ids = body.flexible->node_ids;
  const auto index = std::find(ids.begin(), ids.end(), node) - ids.begin();
  return body.X_DB * Vector3(body.flexible->node_position.col(index));
}

int read_node(const Value& node, const Scene::Body& body) {
  if (!body.flexible) {
    node.refuse(fmt::format("the body '{}' has no nodes", body.name),
                "name a position with 'at', or give the body a 'flexible' block");
  }
  const std::vector<int>& ids = body.flexible->node_ids;
  const int number = node.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (std::find(ids.begin(), ids.end(), number) == ids.end()) {
    node.refuse(fmt::format("the body '{}' has no such node", body.name),
                identification_sections::nodes_text(ids));
  }
  return number;
}

Vector3 frame_place(const Scene::Body& body, int frame) {
  return body.X_DB * body.flexible->frames[static_cast<std::size_t>(frame)].centre_B;
}

int read_frame_name(const Value& frame, const Scene::Body& body) {
  if (!body.flexible || body.flexible->frames.empty()) {
    frame.refuse(fmt::format("the body '{}' has no frames", body.name),
                 "describe it under 'frames' of its 'flexible'");
  }
  return index_of(body.flexible->frames, frame, fmt::format("the frames of '{}'", body.name));
}

void read_bodies(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    if (name == "ground")
      value.refuse("'ground' is the name of the inertial frame", "give the body another name");
    scene.bodies.push_back(read_body_keys(name, value, scene));
  }
  if (scene.bodies.empty()) section.refuse("there are no bodies", "describe at least one");
}

}  // namespace wishbone::scene_sections
