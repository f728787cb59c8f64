#include "models/scene_loader.h"

#include <algorithm>
#include <iterator>

#include "core/document.h"
#include "core/parameters.h"
#include "core/yaml.h"
#include "models/scene_doubts.h"
#include "models/scene_sections.h"

namespace wishbone {
namespace {

constexpr int kFormatVersion = 1;

/// Turns the design frame about an axis through a point that stays in place: p_WP = o + R (p_DP - o).
Pose read_placement(const Value& value, Warnings& warnings) {
  const Mapping keys(value, {"axis", "angle", "origin"});
  const Matrix3 R_WD = scene_sections::read_rotation(keys.required("axis"), keys.required("angle"));
  scene_sections::doubt_angle(keys.required("angle"), warnings);
  const auto origin = keys.optional("origin");
  const Vector3 o = origin ? origin->vector3(kLength) : Vector3(Vector3::Zero());
  return {R_WD, o - R_WD * o};
}

void read_header(const Mapping& root, Scene& scene) {
  const Value version = root.required("wishbone");
  if (version.integer(1, 1000) != kFormatVersion) {
    version.refuse("this format version is not known", "write 'wishbone: 1', or use a newer wishbone");
  }
  if (const auto title = root.optional("title")) scene.title = title->text();
  if (const auto gravity = root.optional("gravity")) scene.gravity = gravity->vector3(kAcceleration);
  if (const auto placement = root.optional("placement"))
    scene.X_WD = read_placement(*placement, scene.warnings);
}

/// What expressions of functions can calculate with.
void read_parameters(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    const YamlNode& scalar = *value.node();
    if (is_boolean(scalar)) {
      scene.parameters[name] = value.boolean() ? 1.0 : 0.0;
    } else if (!scalar.quoted && looks_like_number(scalar.text)) {
      scene.parameters[name] = located(value.where(), [&] { return parse_quantity(scalar.text).value; });
    }
  }
}

std::vector<std::string> names_in(const std::optional<Value>& section) {
  std::vector<std::string> names;
  if (section) {
    for (const auto& [name, _] : section->named()) names.push_back(name);
  }
  return names;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  using namespace scene_sections;
  const YamlNodePtr document = load_document(path, overrides);
  const Mapping root(
      Value(document, document->where),
      {"wishbone", "title", "parameters", "gravity", "placement", "bodies", "joints", "closures", "springs",
       "signals", "loads", "tire_models", "tires", "road", "motions", "vehicle", "analysis", "output"});
  Scene scene;
  scene.text = dump_yaml(*document);
  if (const auto parameters = root.optional("parameters")) read_parameters(*parameters, scene);
  read_header(root, scene);
  const auto read = [&](std::string_view key, auto reader) {
    if (const auto section = root.optional(key)) reader(*section, scene);
  };
  read_bodies(root.required("bodies"), scene);
  const std::vector<std::string> motion_names = names_in(root.optional("motions"));
  if (const auto joints = root.optional("joints")) read_joints(*joints, motion_names, scene);
  check_topology(scene);
  if (const auto closures = root.optional("closures")) read_closures(*closures, motion_names, scene);
  read("signals", read_signals);
  read("motions", read_motions);
  read("springs", read_springs);
  read("loads", read_loads);
  read("road", read_road);
  read("tire_models", read_tire_models);
  read("tires", read_tires);
  read("vehicle", read_vehicle);
  read("analysis", read_analysis);
  check_motions(scene);
  read("output", read_output);
  std::ranges::move(doubts_of(scene), std::back_inserter(scene.warnings));
  return scene;
}

}  // namespace wishbone
