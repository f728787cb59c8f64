#include <fmt/format.h>

#include "core/expression.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

using Type = Scene::SignalType;

/// A name that expressions can use and that has no other meaning there.
void check_name(const std::string& name, const Value& value, const Scene& scene) {
  check_identifier(name, value.where(), "signal");
  if (name == "t") value.refuse("'t' is the time", "use another name");
  if (is_expression_word(name))
    value.refuse(fmt::format("'{}' has a meaning in every expression", name), "use another name");
  if (scene.parameters.contains(name))
    value.refuse(fmt::format("'{}' is a parameter too", name), "rename one of them: expressions use both");
}

void read_component(const Value& value, const Scene& scene, Scene::Signal& signal) {
  const Mapping keys(value, {"body", "at", "node", "frame", "component", "quantity"});
  signal.type = Type::kComponent;
  signal.from = read_point(scene, keys, value);
  signal.axis = keys.required("component").choice<int>({{"x", 0}, {"y", 1}, {"z", 2}}, "the components");
}

void read_distance(const Value& value, const Scene& scene, Scene::Signal& signal) {
  const Mapping keys(value, {"from", "to", "quantity"});
  signal.type = Type::kDistance;
  signal.from = read_end(scene, keys.required("from"));
  signal.to = read_end(scene, keys.required("to"));
  if (signal.from.body == signal.to.body)
    keys.refuse("both points are on the same body", "name points of two bodies");
}

Scene::Signal read_signal(const std::string& name, const Value& value, const Scene& scene) {
  Scene::Signal signal;
  signal.name = name;
  signal.where = value.where();
  check_name(name, value, scene);
  const Mapping any(
      value, {"joint", "coordinate", "from", "to", "body", "at", "node", "frame", "component", "quantity"});
  if (any.has("joint")) {
    const Mapping keys(value, {"joint", "coordinate", "quantity"});
    signal.type = Type::kCoordinate;
    signal.of = read_joint_coordinate(keys, scene);
  } else if (any.has("from")) {
    read_distance(value, scene, signal);
  } else if (any.has("body")) {
    read_component(value, scene, signal);
  } else {
    any.refuse("the signal measures nothing",
               "give 'joint', or 'from' and 'to' for a distance, or 'body' and 'component'");
  }
  if (const auto quantity = any.optional("quantity"))
    signal.is_speed =
        quantity->choice<bool>({{"position", false}, {"speed", true}}, "the quantities of a signal");
  return signal;
}

}  // namespace

const Dimension& dimension_of(const Scene::Signal& signal, const Scene& scene) {
  if (signal.type == Type::kCoordinate && is_angle(signal.of, scene))
    return signal.is_speed ? kAngularVelocity : kAngle;
  return signal.is_speed ? kVelocity : kLength;
}

void read_signals(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) scene.signals.push_back(read_signal(name, value, scene));
}

}  // namespace wishbone::scene_sections
