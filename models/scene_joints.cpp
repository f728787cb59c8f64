#include <fmt/format.h>

#include <algorithm>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

using JointType = Scene::JointType;

/// Two points that a joint holds together must coincide this well in the design pose [m].
constexpr double kCoincidence = 1e-6;

bool has_coordinate(JointType type) {
  return type == JointType::kRevolute || type == JointType::kPrismatic;
}

/// One of the two `bodies` of a joint: `ground`, a body, or {body, node}.
struct Side {
  Value value;
  Scene::Point point;
};

Side read_side(const Scene& scene, const Value& value) {
  Side side{value, {}};
  if (value.is_word("ground")) return side;
  if (!value.is_mapping()) {
    side.point.body = read_body(scene, value);
    return side;
  }
  const Mapping keys(value, {"body", "node"});
  side.point.body = read_body(scene, keys.required("body"));
  const Scene::Body& body = scene.bodies[static_cast<std::size_t>(side.point.body)];
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

/// A flexible body is held at a node, by a joint that leaves the node free to turn; or floats as a whole.
void check_hold(const Scene& scene, const Side& side, JointType type) {
  if (type == JointType::kFree) {
    if (side.point.node != 0)
      side.value.refuse("a free joint joins whole bodies", "name the body without a node");
    return;
  }
  if (side.point.body == Scene::kGround) return;
  const Scene::Body& body = scene.bodies[static_cast<std::size_t>(side.point.body)];
  if (body.form == Scene::BodyForm::kRigid) return;
  if (side.point.node == 0) {
    side.value.refuse(fmt::format("the flexible body '{}' can be held at its nodes only", body.name),
                      fmt::format("write {{body: {}, node: ...}}", body.name));
  }
  if (type != JointType::kSpherical) {
    side.value.refuse("a node of a flexible body can only be held by a spherical joint",
                      "use 'type: spherical'");
  }
}

/// Gives both points their common position: `at`, that of the node, or both when they agree.
void place(const Mapping& keys, Side& parent, Side& child) {
  const auto at = keys.optional("at");
  const auto disagrees = [](const Vector3& a, const Vector3& b) { return !((a - b).norm() <= kCoincidence); };
  if (!at && parent.point.node == 0 && child.point.node == 0) keys.required("at");  // which is missing
  const Vector3 p_DP = at                       ? at->vector3(kLength)
                       : parent.point.node != 0 ? parent.point.p_DP
                                                : child.point.p_DP;
  for (Side* side : {&parent, &child}) {
    if (side->point.node == 0) {
      side->point.p_DP = p_DP;
    } else if (disagrees(side->point.p_DP, p_DP)) {
      const Vector3& n = side->point.p_DP;
      side->value.refuse(
          fmt::format("the node is at [{:.6g}, {:.6g}, {:.6g}], the joint at [{:.6g}, {:.6g}, {:.6g}]", n.x(),
                      n.y(), n.z(), p_DP.x(), p_DP.y(), p_DP.z()),
          "name another node, or correct or remove 'at'");
    }
  }
}

void refuse_keys(const Mapping& keys, std::initializer_list<std::string_view> names,
                 const std::string& reason) {
  for (const auto name : names) {
    if (const auto value = keys.optional(name)) value->refuse(reason, fmt::format("remove '{}'", name));
  }
}

void read_coordinate(const Mapping& keys, const std::vector<std::string>& motion_names, Scene::Joint& joint) {
  if (!has_coordinate(joint.type)) {
    refuse_keys(keys, {"axis", "position", "speed", "motion"},
                "only revolute and prismatic joints have this key");
    return;
  }
  joint.axis_D = keys.required("axis").direction();
  if (joint.cut)
    refuse_keys(keys, {"position", "speed", "motion"}, "a cut joint has no coordinate of its own");
  if (const auto motion = keys.optional("motion")) {
    refuse_keys(keys, {"position", "speed"}, "the motion prescribes the coordinate");
    joint.motion = index_of(motion_names, *motion, "the motions");
    return;
  }
  const bool turns = joint.type == JointType::kRevolute;
  if (const auto position = keys.optional("position"))
    joint.position = position->number(turns ? kAngle : kLength);
  if (const auto speed = keys.optional("speed"))
    joint.speed = speed->number(turns ? kAngularVelocity : kVelocity);
}

Scene::Joint read_joint(const std::string& name, const Value& value,
                        const std::vector<std::string>& motion_names, const Scene& scene) {
  const Mapping keys(value, {"type", "bodies", "at", "axis", "cut", "position", "speed", "motion"});
  Scene::Joint joint;
  joint.name = name;
  joint.where = value.where();
  joint.type = keys.required("type").choice<JointType>({{"fixed", JointType::kFixed},
                                                        {"revolute", JointType::kRevolute},
                                                        {"prismatic", JointType::kPrismatic},
                                                        {"spherical", JointType::kSpherical},
                                                        {"free", JointType::kFree}},
                                                       "the joint types");
  if (const auto cut = keys.optional("cut")) joint.cut = cut->boolean();
  if (joint.cut && joint.type != JointType::kSpherical && joint.type != JointType::kRevolute) {
    keys.required("cut").refuse("only spherical and revolute joints can be cut joints",
                                "cut the loop at another joint");
  }

  auto [parent, child] = read_sides(scene, keys.required("bodies"));
  if (!joint.cut && child.point.body == Scene::kGround) {
    child.value.refuse("a joint cannot carry the ground",
                       "write [ground, body]: the first-named carries the second");
  }
  check_hold(scene, parent, joint.type);
  check_hold(scene, child, joint.type);
  if (joint.type == JointType::kFree) {
    refuse_keys(keys, {"at"}, "a free joint has no place");
    child.point.p_DP = scene.bodies[static_cast<std::size_t>(child.point.body)].X_DB.p;
    parent.point.p_DP = child.point.p_DP;
  } else {
    place(keys, parent, child);
  }
  joint.parent = parent.point;
  joint.child = child.point;
  read_coordinate(keys, motion_names, joint);
  return joint;
}

/// The tree joint that carries each body; -1 for those that float. Throws when there are two.
std::vector<int> carrying_joints(const Scene& scene) {
  std::vector<int> carrier(scene.bodies.size(), -1);
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Scene::Joint& joint = scene.joints[j];
    if (joint.cut) continue;
    int& known = carrier[static_cast<std::size_t>(joint.child.body)];
    if (known >= 0) {
      throw InputError({joint.where.text(),
                        fmt::format("the body '{}' is carried by two joints, '{}' and '{}'",
                                    scene.bodies[static_cast<std::size_t>(joint.child.body)].name,
                                    scene.joints[static_cast<std::size_t>(known)].name, joint.name),
                        "", "make one of them a cut joint ('cut: true'), or swap its bodies"});
    }
    known = static_cast<int>(j);
  }
  return carrier;
}

void check_no_cycle(const Scene& scene, const std::vector<int>& carrier) {
  enum class Mark { kUnseen, kOnPath, kDone };
  std::vector<Mark> marks(scene.bodies.size(), Mark::kUnseen);
  for (std::size_t start = 0; start < scene.bodies.size(); ++start) {
    std::vector<std::size_t> path;
    int body = static_cast<int>(start);
    while (body != Scene::kGround && marks[static_cast<std::size_t>(body)] == Mark::kUnseen) {
      const auto b = static_cast<std::size_t>(body);
      marks[b] = Mark::kOnPath;
      path.push_back(b);
      body = carrier[b] < 0 ? Scene::kGround : scene.joints[static_cast<std::size_t>(carrier[b])].parent.body;
    }
    if (body != Scene::kGround && marks[static_cast<std::size_t>(body)] == Mark::kOnPath) {
      std::vector<std::string> names;
      for (auto it = std::find(path.begin(), path.end(), static_cast<std::size_t>(body)); it != path.end();
           ++it) {
        names.push_back(scene.joints[static_cast<std::size_t>(carrier[*it])].name);
      }
      const auto last = scene.joints[static_cast<std::size_t>(carrier[static_cast<std::size_t>(body)])];
      throw InputError({last.where.text(),
                        fmt::format("the tree joints form a cycle: {}", fmt::join(names, ", ")), "",
                        "make one of them a cut joint ('cut: true')"});
    }
    for (const std::size_t b : path) marks[b] = Mark::kDone;
  }
}

}  // namespace

void read_joints(const Value& section, const std::vector<std::string>& motion_names, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    scene.joints.push_back(read_joint(name, value, motion_names, scene));
  }
}

void check_tree(const Scene& scene) {
  const std::vector<int> carrier = carrying_joints(scene);
  check_no_cycle(scene, carrier);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Scene::Body& body = scene.bodies[b];
    if (carrier[b] < 0 || (body.v_WBo.isZero(0) && body.w_WB_B.isZero(0))) continue;
    const Scene::Joint& joint = scene.joints[static_cast<std::size_t>(carrier[b])];
    if (joint.type == JointType::kFree && joint.parent.body == Scene::kGround) continue;
    throw InputError({body.where.text(),
                      fmt::format("the velocity of the body follows from the joint '{}'", joint.name), "",
                      "remove 'velocity' and 'angular_velocity'; give the joint a 'speed' if it moves"});
  }
}

}  // namespace wishbone::scene_sections
