#include <fmt/format.h>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

using Type = Scene::ClosureType;

void read_points(const Mapping& keys, const Scene& scene, Scene::Closure& closure) {
  closure.from = read_end(scene, keys.required("from"));
  closure.to = read_end(scene, keys.required("to"));
  if (closure.from.body == closure.to.body)
    keys.refuse("both points are on the same body", "name points of two bodies");
}

void read_distance(const Value& value, const std::vector<std::string>& motion_names, const Scene& scene,
                   Scene::Closure& closure) {
  const Mapping keys(value, {"type", "from", "to", "length", "motion"});
  read_points(keys, scene, closure);
  if (const auto motion = keys.optional("motion")) {
    if (keys.has("length")) keys.refuse("the motion prescribes the length", "remove 'length'");
    closure.motion = index_of(motion_names, *motion, "the motions");
    return;
  }
  if (const auto length = keys.optional("length")) closure.length = length->positive(kLength);
  constexpr double kShortest = 1e-9;
  if (!closure.length && !((closure.from.p_DP - closure.to.p_DP).norm() > kShortest))
    value.refuse(
        "the points coincide in the design pose",
        "join them by a spherical joint; or set them apart, by 'position' of a joint or another design "
        "pose, and give 'length'");
}

void read_guided_point(const Value& value, const Scene& scene, Scene::Closure& closure) {
  const Mapping keys(value, {"type", "from", "to", "direction"});
  read_points(keys, scene, closure);
  closure.direction_D = keys.required("direction").direction();
}

bool is_same(const Scene::JointCoordinate& a, const Scene::JointCoordinate& b) {
  return a.joint == b.joint && a.coordinate == b.coordinate;
}

/// sum factor u = constant, by its terms.
void read_coupling(const Value& value, const Scene& scene, Scene::Closure& closure) {
  const Mapping keys(value, {"type", "terms", "constant"});
  for (const Value& item : keys.required("terms").list()) {
    const Mapping term(item, {"joint", "coordinate", "factor"});
    const double factor = term.required("factor").number(kRatio);
    if (factor == 0) item.refuse("the factor of a term is zero", "remove the term");
    const Scene::JointCoordinate of = read_joint_coordinate(term, scene);
    for (const Scene::Closure::Term& other : closure.terms)
      if (is_same(of, other.of))
        item.refuse("the coordinate is in the coupling already", "name another, or add both factors up");
    closure.terms.push_back({of, factor});
  }
  if (closure.terms.empty()) value.refuse("the coupling has no terms", "name joints and factors");
  if (const auto constant = keys.optional("constant")) closure.constant = constant->number(kRatio);
}

/// u_driven = ratio u_driver: gears by their ratio, rack and pinion by the pitch radius.
void read_pair(const Value& value, std::string_view ratio_key, const Dimension& ratio, const Scene& scene,
               Scene::Closure& closure) {
  const Mapping keys(value, {"type", "driver", "driven", ratio_key});
  const auto side = [&](std::string_view key) {
    return read_joint_coordinate(Mapping(keys.required(key), {"joint", "coordinate"}), scene);
  };
  const double factor = keys.required(ratio_key).number(ratio);
  if (factor == 0) keys.refuse(fmt::format("'{}' is zero", ratio_key), "give the transmission");
  closure.terms = {{side("driven"), 1.0}, {side("driver"), -factor}};
  if (is_same(closure.terms[0].of, closure.terms[1].of))
    keys.required("driven").refuse("the coordinate is driven by itself", "name the joint of the other part");
}

Scene::Closure read_closure(const std::string& name, const Value& value,
                            const std::vector<std::string>& motion_names, const Scene& scene) {
  Scene::Closure closure;
  closure.name = name;
  closure.where = value.where();
  enum class Word { distance, line, plane, coupling, gear, rack };
  const Mapping any(value, {"type", "from", "to", "length", "motion", "direction", "terms", "constant",
                            "driver", "driven", "ratio", "radius"});
  switch (any.required("type").choice<Word>({{"distance", Word::distance},
                                             {"point_on_line", Word::line},
                                             {"point_on_plane", Word::plane},
                                             {"coupling", Word::coupling},
                                             {"gear", Word::gear},
                                             {"rack_and_pinion", Word::rack}},
                                            "the closures")) {
    case Word::distance:
      closure.type = Type::kDistance;
      read_distance(value, motion_names, scene, closure);
      break;
    case Word::line:
      closure.type = Type::kPointOnLine;
      read_guided_point(value, scene, closure);
      break;
    case Word::plane:
      closure.type = Type::kPointOnPlane;
      read_guided_point(value, scene, closure);
      break;
    case Word::coupling:
      closure.type = Type::kCoupling;
      read_coupling(value, scene, closure);
      break;
    case Word::gear:
      closure.type = Type::kCoupling;
      read_pair(value, "ratio", kRatio, scene, closure);
      break;
    case Word::rack:
      closure.type = Type::kCoupling;
      read_pair(value, "radius", kLength, scene, closure);
      break;
  }
  return closure;
}

}  // namespace

Scene::JointCoordinate read_joint_coordinate(const Mapping& keys, const Scene& scene) {
  const Value name = keys.required("joint");
  const int joint = index_of(scene.joints, name, "the joints");
  const JointKindInfo& kind = info(scene.joints[static_cast<std::size_t>(joint)].kind);
  const auto& coordinates = kind.coordinates;
  if (coordinates.empty() || !coordinates.front().measurable)
    name.refuse(fmt::format("a {} joint has no coordinate that can be measured", kind.name),
                "name a joint with an angle or a travel");
  const auto which = keys.optional("coordinate");
  if (!which && coordinates.size() == 1) return {joint, 0};
  std::vector<std::string> names;
  for (const JointCoordinateKind& coordinate : coordinates) names.emplace_back(coordinate.name);
  return {joint,
          index_of(names, which ? *which : keys.required("coordinate"), "the coordinates of the joint")};
}

bool is_angle(const Scene::JointCoordinate& coordinate, const Scene& scene) {
  const Scene::Joint& joint = scene.joints[static_cast<std::size_t>(coordinate.joint)];
  return info(joint.kind).coordinates[static_cast<std::size_t>(coordinate.coordinate)].is_angle;
}

void read_closures(const Value& section, const std::vector<std::string>& motion_names, Scene& scene) {
  for (const auto& [name, value] : section.named())
    scene.closures.push_back(read_closure(name, value, motion_names, scene));
}

}  // namespace wishbone::scene_sections
