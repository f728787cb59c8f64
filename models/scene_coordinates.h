#pragma once

#include <string_view>
#include <vector>

#include "core/yaml.h"
#include "models/scene.h"

/// What scene files say of the coordinates of one joint.
namespace wishbone::scene_sections {

inline std::vector<std::string_view> coordinate_names(const JointKindInfo& kind) {
  std::vector<std::string_view> names;
  for (const JointCoordinateKind& coordinate : kind.coordinates) names.push_back(coordinate.name);
  return names;
}

/// Values of the coordinates of a joint: a scalar where it has one, else a mapping by name.
template <class Read>
void for_each_coordinate(const Value& value, const JointKindInfo& kind, Read read) {
  if (kind.coordinates.size() == 1) return read(0, value);
  const Mapping keys(value, coordinate_names(kind));
  for (std::size_t i = 0; i < kind.coordinates.size(); ++i)
    if (const auto own = keys.optional(kind.coordinates[i].name)) read(static_cast<int>(i), *own);
}

/// The keys `spring`, `friction` and `limits` of a joint: force laws on its coordinates.
void read_joint_forces(const Mapping& keys, const JointKindInfo& kind, Scene::Joint& joint);

}  // namespace wishbone::scene_sections
