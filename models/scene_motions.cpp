#include <fmt/format.h>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

/// What a motion prescribes: the angle or the length of the joint coordinates and distances that follow it.
const Dimension& prescribed(const Scene& scene, int motion, const Value& place) {
  const Dimension* dimension = nullptr;
  const auto follow = [&](const Dimension& wanted) {
    if (dimension && dimension != &wanted)
      place.refuse("an angle and a length follow the same motion", "write one motion for each");
    dimension = &wanted;
  };
  for (const Scene::Joint& joint : scene.joints)
    for (std::size_t i = 0; i < joint.motion.size(); ++i)
      if (joint.motion[i] == motion) follow(info(joint.kind).coordinates[i].is_angle ? kAngle : kLength);
  for (const Scene::Closure& closure : scene.closures)
    if (closure.motion == motion) follow(kLength);
  return dimension ? *dimension : kAngle;
}

Scene::MotionStep read_step(const Value& value, const Dimension& dimension) {
  const Mapping keys(value, {"time", "duration", "change"});
  return {keys.required("time").non_negative(kTime), keys.required("duration").positive(kTime),
          keys.required("change").number(dimension)};
}

Scene::Ackermann read_ackermann(const Value& value) {
  const Mapping keys(value, {"wheelbase", "track", "side"});
  return {keys.required("wheelbase").positive(kLength), keys.required("track").positive(kLength),
          keys.required("side").choice<Scene::Side>(
              {{"left", Scene::Side::kLeft}, {"right", Scene::Side::kRight}}, "the sides")};
}

}  // namespace

void read_motions(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    const Mapping keys(value, {"start", "steps", "ackermann"});
    const Dimension& dimension = prescribed(scene, static_cast<int>(scene.motions.size()), value);
    Scene::Motion motion;
    motion.name = name;
    motion.where = value.where();
    if (const auto start = keys.optional("start")) motion.start = start->number(dimension);
    if (const auto steps = keys.optional("steps")) {
      for (const Value& step : steps->list()) motion.steps.push_back(read_step(step, dimension));
    }
    if (const auto ackermann = keys.optional("ackermann")) {
      if (&dimension != &kAngle)
        ackermann->refuse("Ackermann's map is for angles", "let a revolute joint follow this motion");
      motion.ackermann = read_ackermann(*ackermann);
    }
    scene.motions.push_back(motion);
  }
}

}  // namespace wishbone::scene_sections
