#pragma once

#include "models/scene.h"
#include "solver/system_builder.h"

namespace wishbone {

/// What a point of a scene takes hold of: a flexible body at its node or frame, a rigid one (whose nodes and frames are but
/// points of it) as a whole.
inline Attachment attachment_of(const Scene& scene, const Scene::Point& point) {
  const bool flexible = point.body != Scene::kGround && scene.bodies[point.body].is_flexible();
  if (!flexible) return {point.body};
  return {point.body, point.node, point.frame};
}

}  // namespace wishbone
