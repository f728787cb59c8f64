#include "models/interface_nodes.h"

#include <set>

namespace wishbone {

std::vector<int> interface_nodes(const Scene& scene, int body) {
  std::set<int> nodes;
  if (const auto& flexible = scene.bodies[static_cast<std::size_t>(body)].flexible)
    for (const Scene::Frame& frame : flexible->frames)
      if (frame.rigid) nodes.insert(frame.nodes.begin(), frame.nodes.end());
  const auto note = [&](const Scene::Point& point) {
    if (point.body != body) return;
    if (point.node != 0) nodes.insert(point.node);
    if (point.frame >= 0) {
      const auto& frame = scene.bodies[static_cast<std::size_t>(body)]
                              .flexible->frames[static_cast<std::size_t>(point.frame)];
      nodes.insert(frame.nodes.begin(), frame.nodes.end());
    }
  };
  for (const Scene::Joint& joint : scene.joints) {
    note(joint.first);
    note(joint.second);
  }
  for (const Scene::Closure& closure : scene.closures) {
    note(closure.from);
    note(closure.to);
  }
  for (const Scene::Spring& spring : scene.springs) {
    note(spring.from);
    note(spring.to);
  }
  for (const Scene::Load& load : scene.loads) note(load.point);
  return {nodes.begin(), nodes.end()};
}

}  // namespace wishbone
