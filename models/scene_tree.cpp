#include "models/scene_tree.h"

#include <algorithm>

namespace wishbone {

int closure_rows(const Scene::Joint& joint) {
  const auto driven = std::count_if(joint.motion.begin(), joint.motion.end(), [](int m) { return m >= 0; });
  return info(joint.kind).closure_rows + static_cast<int>(driven);
}

namespace {

SpanningTree span_bodies(const Scene& scene, bool floats, bool pinned) {
  std::vector<GraphBody> bodies;
  for (const Scene::Body& body : scene.bodies) {
    const auto moves = [](const std::optional<Vector3>& v) { return v && !v->isZero(0); };
    bodies.push_back({floats && body.is_flexible(), moves(body.v_WBo) || moves(body.w_WB_B)});
  }
  std::vector<GraphJoint> joints;
  for (const Scene::Joint& joint : scene.joints)
    joints.push_back({joint.first.body, joint.second.body, closure_rows(joint),
                      pinned ? joint.cut : std::nullopt, joint.starts()});
  return span(bodies, joints);
}

}  // namespace

SpanningTree scene_tree(const Scene& scene) {
  return span_bodies(scene, true, true);
}

SpanningTree rigid_tree(const Scene& scene) {
  return span_bodies(scene, false, true);
}

SpanningTree start_tree(const Scene& scene) {
  return span_bodies(scene, false, false);
}

}  // namespace wishbone
