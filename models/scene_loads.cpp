#include <fmt/format.h>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

Scene::Load read_load(const std::string& name, const Value& value, Scene& scene) {
  const Mapping keys(value, {"body", "at", "node", "frame", "force", "moment", "axes"});
  Scene::Load load;
  load.name = name;
  load.where = value.where();
  load.point = read_point(scene, keys, value);
  if (!keys.has("force") && !keys.has("moment")) keys.refuse("the load is empty", "give 'force' or 'moment'");
  if (const auto force = keys.optional("force")) load.force = read_functions(*force, kForce, scene);
  if (const auto moment = keys.optional("moment")) load.moment = read_functions(*moment, kMoment, scene);
  if (const auto axes = keys.optional("axes")) {
    load.in_body_axes = axes->choice<bool>({{"inertial", false}, {"body", true}}, "the axes of a load");
  }
  return load;
}

/// A load on the coordinate of a joint: a moment on an angle, a force on a travel.
Scene::Drive read_drive(const std::string& name, const Value& value, Scene& scene) {
  const Mapping keys(value, {"joint", "coordinate", "force", "moment"});
  Scene::Drive drive;
  drive.name = name;
  drive.where = value.where();
  drive.along = read_joint_coordinate(keys, scene);
  const bool turns = is_angle(drive.along, scene);
  if (const auto other = keys.optional(turns ? "force" : "moment"))
    other->refuse(turns ? "the coordinate is an angle" : "the coordinate is a length",
                  turns ? "give a 'moment'" : "give a 'force'");
  drive.force = read_function(keys.required(turns ? "moment" : "force"), turns ? kMoment : kForce, scene);
  return drive;
}

}  // namespace

void read_loads(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    const Mapping any(value,
                      {"body", "at", "node", "frame", "force", "moment", "axes", "joint", "coordinate"});
    if (any.has("joint"))
      scene.drives.push_back(read_drive(name, value, scene));
    else
      scene.loads.push_back(read_load(name, value, scene));
  }
}

}  // namespace wishbone::scene_sections
