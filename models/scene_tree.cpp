#include "models/scene_tree.h"

#include <algorithm>

namespace wishbone {

int closure_rows(const Scene::Joint& joint) {
  const auto driven = std::count_if(joint.motion.begin(), joint.motion.end(), [](int m) { return m >= 0; });
  return info(joint.kind).closure_rows + static_cast<int>(driven);
}

SpanningTree scene_tree(const Scene& scene) {
  std::vector<GraphBody> bodies;
  for (const Scene::Body& body : scene.bodies) {
    const bool moves = !body.v_WBo.isZero(0) || !body.w_WB_B.isZero(0);
    bodies.push_back({body.is_flexible(), moves});
  }
  std::vector<GraphJoint> joints;
  for (const Scene::Joint& joint : scene.joints)
    joints.push_back({joint.first.body, joint.second.body, closure_rows(joint), joint.cut,
                      !joint.position.empty() || !joint.speed.empty()});
  return span(bodies, joints);
}

}  // namespace wishbone
