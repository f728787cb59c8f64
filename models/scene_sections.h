#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/did_you_mean.h"
#include "core/yaml.h"
#include "identification/elements/isotropic_material.h"
#include "models/scene.h"

/// Readers of the sections of a scene file, for the scene loader only. Each fills its part of the scene and
/// relies on the parts that were read before it: bodies, then joints, then the rest.
namespace wishbone::scene_sections {

void read_bodies(const Value& section, Scene& scene);
void read_joints(const Value& section, const std::vector<std::string>& motion_names, Scene& scene);
void read_closures(const Value& section, const std::vector<std::string>& motion_names, Scene& scene);
void read_signals(const Value& section, Scene& scene);
void read_springs(const Value& section, Scene& scene);
void read_loads(const Value& section, Scene& scene);
void read_tire_models(const Value& section, Scene& scene);
void read_tires(const Value& section, Scene& scene);
void read_road(const Value& section, Scene& scene);
void read_motions(const Value& section, Scene& scene);
void read_vehicle(const Value& section, Scene& scene);
void read_analysis(const Value& section, Scene& scene);
void read_output(const Value& section, Scene& scene);

/// Checks that span sections: pinned joints fit into a tree, carried bodies have no velocity of their own,
/// joints that close loops no initial coordinate.
void check_topology(const Scene& scene);

/// A coordinate of a joint that a gauge can measure, by the keys `joint` and, where the joint has several,
/// `coordinate`.
Scene::JointCoordinate read_joint_coordinate(const Mapping& keys, const Scene& scene);

bool is_angle(const Scene::JointCoordinate& coordinate, const Scene& scene);

/// Of the numbers that a signal gives.
const Dimension& dimension_of(const Scene::Signal& signal, const Scene& scene);

/// A number, or a function of the time and the signals: {expression: ...} or {table: ...}.
Function read_function(const Value& value, const Dimension& dimension, Scene& scene);
/// Three of them, in a list.
std::array<Function, 3> read_functions(const Value& value, const Dimension& dimension, Scene& scene);
/// What the keys `expression` or `table` of a mapping give, if there is one of them. `usual` is how tables
/// are interpolated that do not say it.
std::optional<Function> read_law(const Mapping& keys, const Dimension& dimension, Table::Interpolation usual,
                                 Scene& scene);

/// Checks that tables of motions span the run.
void check_motions(const Scene& scene);

/// `ground: [x, y, z]` or a point of a body, as springs name their ends.
Scene::Point read_end(const Scene& scene, const Value& value);

/// {axis, angle} as a rotation matrix.
Matrix3 read_rotation(const Value& axis, const Value& angle);

/// Nodes and modes of a flexible body.
Scene::Flexible read_flexible(const Value& value, Scene& scene);

/// Lumped masses of the nodes of a block or model (n) [kg].
VectorX node_masses(const Scene::Flexible& flexible);

/// {young, poisson, density}.
IsotropicMaterial read_material(const Value& value);

/// The block of hexahedra that the keys `block` and `material` describe.
Scene::Block read_block(const Value& block, const Value& material);

/// [Jxx, Jyy, Jzz] or [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz], components of the tensor.
Matrix3 read_inertia(const Value& value);

/// Position of a node in D [m].
Vector3 node_place(const Scene::Body& body, int node);

/// The id of a node of a body; throws InputError when the body has no such node.
int read_node(const Value& node, const Scene::Body& body);

/// Position of the centre of a frame in D [m].
Vector3 frame_place(const Scene::Body& body, int frame);

/// The index of a frame of a body; throws InputError when the body has no such frame.
int read_frame_name(const Value& frame, const Scene::Body& body);

/// Keys that name a point of a body.
inline constexpr std::array<std::string_view, 4> kPointKeys{"body", "at", "node", "frame"};

/// The point of the body that the key `body` names: a node, a position in D that the body or one of its frames carries, by
/// default the mass centre or the centre of the frame. `place` is that of the mapping.
Scene::Point read_point(const Scene& scene, const Mapping& keys, const Value& place);

template <class T>
std::vector<std::string> names_of(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

inline std::vector<std::string> names_of(const std::vector<std::string>& names) {
  return names;
}

inline const std::string& name_of(const std::string& name) {
  return name;
}
template <class T>
const std::string& name_of(const T& thing) {
  return thing.name;
}

/// Index of `name`, which stands at `place`, among names or named things; throws InputError with "did you
/// mean" when it is not there.
template <class T>
int index_of(const std::vector<T>& things, const std::string& name, const Value& place,
             std::string_view kind) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (name_of(things[i]) == name) return static_cast<int>(i);
  }
  throw InputError({place.where().text(), fmt::format("there is no '{}' among {}", name, kind), "",
                    did_you_mean(name, names_of(things), kind)});
}

template <class T>
int index_of(const std::vector<T>& things, const Value& reference, std::string_view kind) {
  return index_of(things, reference.text(), reference, kind);
}

inline int read_body(const Scene& scene, const Value& reference) {
  return index_of(scene.bodies, reference, "the bodies");
}

}  // namespace wishbone::scene_sections
