#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

Scene::Spring read_spring(const std::string& name, const Value& value, const Scene& scene) {
  const Mapping keys(value, {"from", "to", "stiffness", "damping", "free_length"});
  Scene::Spring spring;
  spring.name = name;
  spring.where = value.where();
  spring.from = read_end(scene, keys.required("from"));
  spring.to = read_end(scene, keys.required("to"));
  if (spring.from.body == spring.to.body) keys.refuse("the spring joins a body to itself", "name two bodies");
  spring.stiffness = keys.required("stiffness").non_negative(kStiffness);
  if (const auto damping = keys.optional("damping")) spring.damping = damping->non_negative(kDamping);
  spring.free_length = keys.required("free_length").non_negative(kLength);
  return spring;
}

Scene::TireModel read_tire_model(const std::string& name, const Value& value) {
  const Mapping keys(
      value, {"form", "radius", "vertical_stiffness", "damping_ratio", "mass", "slip_stiffness",
              "cornering_stiffness", "camber_stiffness", "rolling_resistance", "friction_max", "friction_min",
              "lag", "relaxation_longitudinal", "relaxation_lateral"});
  Scene::TireModel tire;
  tire.name = name;
  tire.where = value.where();
  if (const auto form = keys.optional("form")) {
    tire.form = form->choice<Scene::TireForm>(
        {{"smooth", Scene::TireForm::kSmooth}, {"classic", Scene::TireForm::kClassic}},
        "the forms of the tire");
  }
  tire.radius = keys.required("radius").positive(kLength);
  tire.vertical_stiffness = keys.required("vertical_stiffness").positive(kStiffness);
  tire.damping_ratio = keys.required("damping_ratio").non_negative(kRatio);
  tire.mass = keys.required("mass").positive(kMass);
  tire.slip_stiffness = keys.required("slip_stiffness").positive(kForce);
  tire.cornering_stiffness = keys.required("cornering_stiffness").positive(kForcePerAngle);
  tire.camber_stiffness = keys.required("camber_stiffness").non_negative(kForcePerAngle);
  tire.rolling_resistance = keys.required("rolling_resistance").non_negative(kLength);
  tire.friction_max = keys.required("friction_max").positive(kRatio);
  const Value friction_min = keys.required("friction_min");
  tire.friction_min = friction_min.positive(kRatio);
  if (tire.friction_min > tire.friction_max) {
    friction_min.refuse("the friction at full slip exceeds that at zero slip",
                        fmt::format("give at most friction_max = {}", tire.friction_max));
  }
  if (const auto lag = keys.optional("lag")) tire.lag = lag->boolean();
  const auto relaxation = [&](std::string_view key) {
    if (tire.lag) return keys.required(key).positive(kLength);
    const auto length = keys.optional(key);
    return length ? length->positive(kLength) : 0.0;
  };
  tire.relaxation_longitudinal = relaxation("relaxation_longitudinal");
  tire.relaxation_lateral = relaxation("relaxation_lateral");
  return tire;
}

}  // namespace

Scene::Point read_point(const Scene& scene, const Mapping& keys, const Value& place) {
  const int body = read_body(scene, keys.required("body"));
  const Scene::Body& holder = scene.bodies[static_cast<std::size_t>(body)];
  const auto at = keys.optional("at"), node = keys.optional("node"), frame = keys.optional("frame");
  if (node && (at || frame)) {
    place.refuse(fmt::format("the point is named twice, by '{}' and by 'node'", at ? "at" : "frame"),
                 "remove one of them");
  }
  if (node) {
    const int number = read_node(*node, holder);
    return {body, number, node_place(holder, number)};
  }
  if (frame) {
    const int index = read_frame_name(*frame, holder);
    return {body, 0, at ? at->vector3(kLength) : frame_place(holder, index), index};
  }
  if (holder.is_flexible()) {
    place.refuse(fmt::format("the flexible body '{}' can be held at its nodes and frames only", holder.name),
                 "name one with 'node' or 'frame'");
  }
  return {body, 0, at ? at->vector3(kLength) : holder.X_DB.p};
}

Scene::Point read_end(const Scene& scene, const Value& value) {
  const Mapping keys(value, {"ground", "body", "at", "node", "frame"});
  if (const auto ground = keys.optional("ground")) {
    if (std::any_of(kPointKeys.begin(), kPointKeys.end(), [&](auto key) { return keys.has(key); })) {
      value.refuse("a point is on the ground or on a body",
                   "write {ground: [x, y, z]} or {body: ..., at: [x, y, z]}");
    }
    return {Scene::kGround, 0, ground->vector3(kLength)};
  }
  return read_point(scene, keys, value);
}

void read_springs(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) scene.springs.push_back(read_spring(name, value, scene));
}

void read_tire_models(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) scene.tire_models.push_back(read_tire_model(name, value));
}

void read_tires(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    const Mapping keys(value, {"wheel", "model"});
    const Value wheel = keys.required("wheel");
    const int body = read_body(scene, wheel);
    if (scene.bodies[static_cast<std::size_t>(body)].is_flexible()) {
      wheel.refuse("a wheel must be a rigid body", "use 'form: rigid'");
    }
    for (const Scene::Tire& tire : scene.tires) {
      if (tire.wheel == body)
        wheel.refuse(fmt::format("the tire '{}' is on this wheel already", tire.name), "name another wheel");
    }
    const int model = index_of(scene.tire_models, keys.required("model"), "the tire models");
    if (!scene.road)
      value.refuse("a tire needs a road", "add the section 'road', for a flat one as 'road: {}'");
    scene.tires.push_back({name, body, model, value.where()});
  }
}

void read_road(const Value& section, Scene& scene) {
  const Mapping keys(section, {"bank", "depression"});
  Scene::Road road;
  road.where = section.where();
  if (const auto bank = keys.optional("bank")) {
    road.bank = bank->number(kAngle);
    constexpr double kSteepest = 1.5;
    if (!(std::abs(road.bank) <= kSteepest))
      bank->refuse("the bank is too steep for a road", "give an angle within 85 deg");
  }
  if (const auto value = keys.optional("depression")) {
    const Mapping depression(*value, {"start", "length", "depth"});
    road.depression = Scene::Depression{depression.required("start").number(kLength),
                                        depression.required("length").positive(kLength),
                                        depression.required("depth").number(kLength)};
  }
  scene.road = road;
}

}  // namespace wishbone::scene_sections
