#pragma once

#include "models/scene.h"
#include "models/spanning_tree.h"

namespace wishbone {

/// What a joint costs where it closes a loop. A driven coordinate is a row more there, and none in the tree.
int closure_rows(const Scene::Joint& joint);

/// Which joints of a scene carry bodies and which close loops. Flexible bodies float; that joints which hold them are pinned
/// to the tree is met as far as it can be.
SpanningTree scene_tree(const Scene& scene);

/// The same, were all bodies rigid.
SpanningTree rigid_tree(const Scene& scene);

/// The same, were all bodies rigid and nothing pinned: along it a scene starts, whatever its form and its cuts.
SpanningTree start_tree(const Scene& scene);

}  // namespace wishbone
