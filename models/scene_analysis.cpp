#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {

void read_vehicle(const Value& section, Scene& scene) {
  const Mapping keys(section, {"chassis", "steering"});
  Scene::Vehicle vehicle;
  vehicle.where = section.where();
  vehicle.chassis = read_body(scene, keys.required("chassis"));
  if (const auto steering = keys.optional("steering")) {
    for (const auto& [name, value] : steering->named()) {
      const int joint = index_of(scene.joints, value, "the joints");
      const Scene::Joint& steered = scene.joints[static_cast<std::size_t>(joint)];
      if (steered.cut == true || steered.kind != JointKind::revolute) {
        value.refuse("a steering angle is the coordinate of a revolute tree joint", "name such a joint");
      }
      vehicle.steering.push_back({name, joint});
    }
  }
  scene.vehicle = vehicle;
}

void read_analysis(const Value& section, Scene& scene) {
  const Mapping keys(section, {"duration", "form", "integrator", "rtol", "atol", "max_step", "max_steps"});
  Scene::Analysis& analysis = scene.analysis;
  analysis.where = section.where();
  if (const auto duration = keys.optional("duration")) analysis.duration = duration->positive(kTime);
  scene.output.interval = std::min(scene.output.interval, analysis.duration);
  if (const auto form = keys.optional("form")) {
    analysis.form = form->choice<Scene::Form>({{"auto", Scene::Form::kAuto},
                                               {"ode", Scene::Form::kOde},
                                               {"index1", Scene::Form::kIndex1},
                                               {"partition", Scene::Form::kPartition},
                                               {"ggl", Scene::Form::kGgl}},
                                              "the integration forms");
  }
  if (const auto integrator = keys.optional("integrator")) {
    analysis.integrator = integrator->choice<Scene::Integrator>({{"auto", Scene::Integrator::kAuto},
                                                                 {"adams", Scene::Integrator::kAdams},
                                                                 {"bdf", Scene::Integrator::kBdf},
                                                                 {"erk", Scene::Integrator::kErk}},
                                                                "the integrators");
  }
  if (const auto rtol = keys.optional("rtol")) {
    analysis.rtol = rtol->positive(kRatio);
    if (analysis.rtol > 0.1)
      rtol->refuse("the relative tolerance is too coarse to mean anything",
                   "give at most 0.1; 1e-6 is usual");
  }
  if (const auto atol = keys.optional("atol")) analysis.atol = atol->positive(kRatio);
  if (const auto max_step = keys.optional("max_step")) analysis.max_step = max_step->positive(kTime);
  if (const auto max_steps = keys.optional("max_steps")) {
    analysis.max_steps = max_steps->integer(1, std::numeric_limits<int>::max());
  }
}

void read_output(const Value& section, Scene& scene) {
  const Mapping keys(section, {"interval", "nodes", "points"});
  Scene::Output& output = scene.output;
  output.where = section.where();
  if (const auto interval = keys.optional("interval")) {
    output.interval = interval->positive(kTime);
    if (output.interval > scene.analysis.duration) {
      interval->refuse(fmt::format("the interval is longer than the run of {} s", scene.analysis.duration),
                       "give a shorter one");
    }
    constexpr double kMostOutputs = 1e7;
    if (scene.analysis.duration / output.interval > kMostOutputs) {
      interval->refuse("the run would have more than ten million outputs", "give a longer interval");
    }
  }
  if (const auto nodes = keys.optional("nodes")) {
    for (const auto& [name, value] : nodes->named()) {
      Scene::NodeOutput recorded;
      recorded.body = index_of(scene.bodies, name, value, "the bodies");
      const Scene::Body& body = scene.bodies[static_cast<std::size_t>(recorded.body)];
      for (const Value& node : value.list()) recorded.nodes.push_back(read_node(node, body));
      output.nodes.push_back(recorded);
    }
  }
  if (const auto points = keys.optional("points"))
    for (const auto& [name, value] : points->named()) {
      const Mapping point(value, {"body", "at", "node", "frame"});
      output.points.push_back({name, read_point(scene, point, value)});
    }
}

}  // namespace wishbone::scene_sections
