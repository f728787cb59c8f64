#pragma once

#include "models/scene.h"
#include "models/spanning_tree.h"

namespace wishbone {

/// What a joint costs where it closes a loop. A driven coordinate is a row more there, and none in the tree.
int closure_rows(const Scene::Joint& joint);

/// Which joints of a scene carry bodies and which close loops.
SpanningTree scene_tree(const Scene& scene);

}  // namespace wishbone
