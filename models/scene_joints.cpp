#include <fmt/format.h>

#include <cmath>

#include "models/scene_coordinates.h"
#include "models/scene_doubts.h"
#include "models/scene_sections.h"
#include "models/scene_tree.h"

namespace wishbone::scene_sections {
namespace {

/// Two points that a joint holds together must coincide this well in the design pose [m].
constexpr double kCoincidence = 1e-6;

/// One of the two `bodies` of a joint: `ground`, a body, or {body, node} or {body, frame}.
struct Side {
  Value value;
  Scene::Point point;

  bool at_node() const { return point.node != 0; }
  bool on_frame() const { return point.frame >= 0; }
};

Side read_side(const Scene& scene, const Value& value) {
  Side side{value, {}};
  if (value.is_word("ground")) return side;
  if (!value.is_mapping()) {
    side.point.body = read_body(scene, value);
    return side;
  }
  const Mapping keys(value, {"body", "node", "frame"});
  side.point.body = read_body(scene, keys.required("body"));
  const Scene::Body& body = scene.bodies[static_cast<std::size_t>(side.point.body)];
  if (const auto frame = keys.optional("frame")) {
    if (keys.has("node")) value.refuse("the joint is given a node and a frame", "remove one of them");
    side.point.frame = read_frame_name(*frame, body);
    side.point.p_DP = frame_place(body, side.point.frame);
    return side;
  }
  side.point.node = read_node(keys.required("node"), body);
  side.point.p_DP = node_place(body, side.point.node);
  return side;
}

std::pair<Side, Side> read_sides(const Scene& scene, const Value& value) {
  const std::vector<Value> items = value.list();
  if (items.size() != 2) value.refuse("a joint joins two bodies", "write [parent, child]");
  const Side parent = read_side(scene, items[0]);
  const Side child = read_side(scene, items[1]);
  if (parent.point.body == child.point.body)
    value.refuse("the joint joins a body to itself", "name two bodies");
  return {parent, child};
}

/// A flexible body is held at a node, by a joint that leaves the node free to turn; on a frame, by any joint; or floats as a
/// whole.
void check_hold(const Scene& scene, const Side& side, JointKind kind) {
  if (kind == JointKind::free) {
    if (side.at_node() || side.on_frame())
      side.value.refuse("a free joint joins whole bodies", "name the body without a node or frame");
    return;
  }
  if (side.point.body == Scene::kGround || side.on_frame()) return;
  const Scene::Body& body = scene.bodies[static_cast<std::size_t>(side.point.body)];
  if (!body.is_flexible()) return;
  if (!side.at_node()) {
    side.value.refuse(
        fmt::format("the flexible body '{}' can be held at its nodes and frames only", body.name),
        fmt::format("write {{body: {}, node: ...}} or {{body: {}, frame: ...}}", body.name, body.name));
  }
  if (kind != JointKind::spherical) {
    side.value.refuse("a node of a flexible body can only be held by a spherical joint",
                      "use 'type: spherical', or hold a frame over several nodes");
  }
}

bool disagree(const Vector3& a, const Vector3& b) {
  return !((a - b).norm() <= kCoincidence);
}

std::string shown(const Vector3& p) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

/// Where the joint is: `at`, else the node of a side, else the centre of a frame.
Vector3 read_place(const Mapping& keys, const Side& first, const Side& second) {
  if (const auto at = keys.optional("at")) return at->vector3(kLength);
  for (const Side* side : {&first, &second})
    if (side->at_node()) return side->point.p_DP;
  if (first.on_frame() && second.on_frame() && disagree(first.point.p_DP, second.point.p_DP)) {
    keys.refuse(fmt::format("the frames have their centres at {} and {}", shown(first.point.p_DP),
                            shown(second.point.p_DP)),
                "say where the joint is with 'at'; the frames carry it");
  }
  for (const Side* side : {&first, &second})
    if (side->on_frame()) return side->point.p_DP;
  return keys.required("at").vector3(kLength);  // which is missing
}

/// Gives both points the place of the joint, which a node must agree with; a frame carries whatever place it is.
void place(const Mapping& keys, Side& first, Side& second) {
  const Vector3 p_DP = read_place(keys, first, second);
  for (Side* side : {&first, &second}) {
    if (side->at_node() && disagree(side->point.p_DP, p_DP)) {
      side->value.refuse(
          fmt::format("the node is at {}, the joint at {}", shown(side->point.p_DP), shown(p_DP)),
          "name another node, or correct or remove 'at'");
    }
    if (!side->at_node()) side->point.p_DP = p_DP;
  }
}

void refuse_keys(const Mapping& keys, std::initializer_list<std::string_view> names,
                 const std::string& reason) {
  for (const auto name : names) {
    if (const auto value = keys.optional(name)) value->refuse(reason, fmt::format("remove '{}'", name));
  }
}

void refuse_without_coordinates(const Mapping& keys, const JointKindInfo& kind) {
  if (!kind.coordinates.empty()) return;
  const std::string reason = fmt::format("a {} joint has no coordinate of this kind", kind.name);
  refuse_keys(keys, {"position", "motion", "spring", "friction", "limits"}, reason);
  if (kind.name != info(JointKind::spherical).name) refuse_keys(keys, {"speed"}, reason);
}

/// `position` and `speed` of coordinates; of a spherical joint `speed` is its angular velocity.
void read_initial_motion(const Mapping& keys, const JointKindInfo& kind, Scene::Joint& joint,
                         Warnings& warnings) {
  const auto read = [&](std::string_view key, std::vector<std::optional<double>>& values, bool rate) {
    const auto value = keys.optional(key);
    if (!value) return;
    if (joint.kind == JointKind::spherical) {
      joint.spin = value->vector3(kAngularVelocity);
      return;
    }
    values.assign(kind.coordinates.size(), std::nullopt);
    for_each_coordinate(*value, kind, [&](int i, const Value& v) {
      const bool angle = kind.coordinates[i].is_angle;
      values[i] = v.number(rate ? (angle ? kAngularVelocity : kVelocity) : (angle ? kAngle : kLength));
      if (angle && !rate) doubt_joint_angle(v, warnings);
    });
  };
  read("position", joint.position, false);
  read("speed", joint.speed, true);
  if (const auto weight = keys.optional("assembly_weight")) joint.weight = weight->positive(kRatio);
}

void read_motion(const Mapping& keys, const JointKindInfo& kind, const std::vector<std::string>& motion_names,
                 Scene::Joint& joint) {
  const auto motion = keys.optional("motion");
  if (!motion) return;
  joint.motion.assign(kind.coordinates.size(), -1);
  for_each_coordinate(*motion, kind, [&](int i, const Value& name) {
    if (!kind.coordinates[i].measurable)
      name.refuse("this coordinate cannot be driven", "drive a body on another joint");
    joint.motion[i] = index_of(motion_names, name, "the motions");
  });
  if (kind.coordinates.size() == 1)
    refuse_keys(keys, {"position", "speed"}, "the motion prescribes the coordinate");
}

/// Axes of the joint in D, as joints/joint_kind.h has them.
void read_axes(const Mapping& keys, Scene::Joint& joint) {
  const auto refuse = [&](std::initializer_list<std::string_view> names) {
    refuse_keys(keys, names, fmt::format("a {} joint has no such axis", info(joint.kind).name));
  };
  const auto second = [&](const Vector3& normal_to) -> Vector3 {
    const Value value = keys.required("second_axis");
    const Vector3 axis = value.direction();
    constexpr double kRightAngle = 1e-9;
    if (std::abs(axis.dot(normal_to)) > kRightAngle)
      value.refuse("the two axes are not perpendicular", "correct one of them");
    return (axis - axis.dot(normal_to) * normal_to).normalized();
  };
  if (joint.kind != JointKind::screw) refuse_keys(keys, {"pitch"}, "only a screw has a pitch");
  switch (joint.kind) {
    case JointKind::fixed:
    case JointKind::spherical:
    case JointKind::free:
      return refuse({"axis", "second_axis"});
    case JointKind::universal: {
      const Vector3 x = keys.required("axis").direction(), y = second(x);
      joint.R_DJ << x, y, x.cross(y);
      return;
    }
    case JointKind::planar:
    case JointKind::constant_velocity: {
      const Vector3 z = keys.required("axis").direction();
      const Vector3 x = keys.has("second_axis") ? second(z) : perpendiculars(z).first;
      joint.R_DJ << x, z.cross(x), z;
      return;
    }
    default:
      break;
  }
  refuse({"second_axis"});
  const Vector3 z = keys.required("axis").direction();
  const auto [x, y] = perpendiculars(z);
  joint.R_DJ << x, y, z;
  if (joint.kind == JointKind::screw) joint.pitch = keys.required("pitch").number(kPitch);
}

Scene::Joint read_joint(const std::string& name, const Value& value,
                        const std::vector<std::string>& motion_names, Scene& scene) {
  const Mapping keys(value, {"type", "bodies", "at", "axis", "second_axis", "pitch", "cut", "position",
                             "speed", "motion", "assembly_weight", "spring", "friction", "limits"});
  Scene::Joint joint;
  joint.name = name;
  joint.where = value.where();
  joint.kind = keys.required("type").choice<JointKind>({{"fixed", JointKind::fixed},
                                                        {"revolute", JointKind::revolute},
                                                        {"prismatic", JointKind::prismatic},
                                                        {"cylindrical", JointKind::cylindrical},
                                                        {"screw", JointKind::screw},
                                                        {"universal", JointKind::universal},
                                                        {"constant_velocity", JointKind::constant_velocity},
                                                        {"spherical", JointKind::spherical},
                                                        {"planar", JointKind::planar},
                                                        {"free", JointKind::free}},
                                                       "the joint types");
  const JointKindInfo& kind = info(joint.kind);
  if (const auto cut = keys.optional("cut"); cut && !cut->is_word("auto")) joint.cut = cut->boolean();
  if (joint.kind == JointKind::free && joint.cut == true)
    keys.required("cut").refuse("a free joint closes nothing", "remove the joint");

  auto [first, second] = read_sides(scene, keys.required("bodies"));
  check_hold(scene, first, joint.kind);
  check_hold(scene, second, joint.kind);
  if (joint.kind == JointKind::free) {
    refuse_keys(keys, {"at"}, "a free joint has no place");
    const Side& body = second.point.body == Scene::kGround ? first : second;
    second.point.p_DP = scene.bodies[static_cast<std::size_t>(body.point.body)].X_DB.p;
    first.point.p_DP = second.point.p_DP;
  } else {
    place(keys, first, second);
  }
  joint.first = first.point;
  joint.second = second.point;
  read_axes(keys, joint);
  refuse_without_coordinates(keys, kind);
  read_motion(keys, kind, motion_names, joint);
  read_initial_motion(keys, kind, joint, scene.warnings);
  read_joint_forces(keys, kind, joint);
  return joint;
}

}  // namespace

void read_joints(const Value& section, const std::vector<std::string>& motion_names, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    scene.joints.push_back(read_joint(name, value, motion_names, scene));
  }
}

namespace {

/// The joints pinned to the tree must fit into one, were all bodies rigid: what floats because it is flexible is no fault of
/// theirs.
void check_pins(const Scene& scene, const SpanningTree& rigid) {
  if (rigid.impossible.empty()) return;
  std::vector<std::string> names;
  for (const int j : rigid.impossible) names.push_back(scene.joints[static_cast<std::size_t>(j)].name);
  const Scene::Joint& joint = scene.joints[static_cast<std::size_t>(rigid.impossible.front())];
  throw InputError(
      {joint.where.text(),
       fmt::format("not all joints with 'cut: false' fit into one tree: {}", fmt::join(names, ", ")), "",
       "leave one joint of each loop to be cut ('cut: true', or no 'cut')"});
}

/// Of a joint that closes a loop only what can be measured can be given.
void check_start(const Scene::Joint& joint) {
  const JointKindInfo& kind = info(joint.kind);
  for (const auto* values : {&joint.position, &joint.speed})
    for (std::size_t i = 0; i < values->size(); ++i) {
      if (!(*values)[i] || kind.coordinates[i].measurable) continue;
      throw InputError({joint.where.text(),
                        fmt::format("'{}' of a {} joint that closes a loop cannot be given at the start",
                                    kind.coordinates[i].name, kind.name),
                        "", "leave it out, or give another joint of the loop instead"});
    }
}

}  // namespace

void check_topology(const Scene& scene) {
  check_pins(scene, rigid_tree(scene));
  const SpanningTree start = start_tree(scene), tree = scene_tree(scene);
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Scene::Joint& joint = scene.joints[j];
    if (joint.kind == JointKind::free && tree.roles[j] == JointRole::carries_first)
      throw InputError(
          {joint.where.text(), "a free joint carries its second-named body", "", "exchange the two bodies"});
    if (start.roles[j] == JointRole::closes) check_start(joint);
  }
}

}  // namespace wishbone::scene_sections
