#pragma once

#include "models/scene.h"
#include "models/spanning_tree.h"

namespace wishbone {

/// Which joints of a scene carry bodies and which close loops.
SpanningTree scene_tree(const Scene& scene);

}  // namespace wishbone
