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

/// A function of the time; the reader of functions knows the signals too.
void read_motion_law(const Mapping& keys, const Dimension& dimension, Scene& scene, Scene::Motion& motion) {
  motion.law = read_law(keys, dimension, Table::Interpolation::spline, scene);
  if (!motion.law) return;
  if (keys.has("start") || keys.has("steps"))
    keys.refuse("the motion is given twice", "give 'start' and 'steps', or 'expression', or 'table'");
  for (const int variable : motion.law->variables())
    if (variable != Function::kTime)
      keys.refuse(fmt::format("the motion depends on the signal '{}'",
                              scene.signals[static_cast<std::size_t>(variable) - 1].name),
                  "motions are functions of the time t alone; let a load depend on the signal");
  const Table* table = motion.law->table_of_time();
  if (table && table->interpolation() == Table::Interpolation::linear)
    keys.required("table").refuse("a linear table has no acceleration at its points",
                                  "use 'interpolation: spline', or write the motion as steps");
}

}  // namespace

void check_motions(const Scene& scene) {
  for (const Scene::Motion& motion : scene.motions) {
    const Table* table = motion.law ? motion.law->table_of_time() : nullptr;
    if (!table || (table->first() <= 0 && table->last() >= scene.analysis.duration)) continue;
    throw InputError({motion.where.text(),
                      fmt::format("the table spans {} s to {} s, the run 0 s to {} s", table->first(),
                                  table->last(), scene.analysis.duration),
                      "",
                      "give points for the whole run, or shorten it: at an end the motion need not rest"});
  }
}

void read_motions(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    const Mapping keys(value, {"start", "steps", "expression", "table", "ackermann"});
    const Dimension& dimension = prescribed(scene, static_cast<int>(scene.motions.size()), value);
    Scene::Motion motion;
    motion.name = name;
    motion.where = value.where();
    if (const auto start = keys.optional("start")) motion.start = start->number(dimension);
    if (const auto steps = keys.optional("steps")) {
      for (const Value& step : steps->list()) motion.steps.push_back(read_step(step, dimension));
    }
    read_motion_law(keys, dimension, scene, motion);
    if (const auto ackermann = keys.optional("ackermann")) {
      if (&dimension != &kAngle)
        ackermann->refuse("Ackermann's map is for angles", "let a revolute joint follow this motion");
      motion.ackermann = read_ackermann(*ackermann);
    }
    scene.motions.push_back(motion);
  }
}

}  // namespace wishbone::scene_sections
