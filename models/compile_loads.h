#pragma once

#include "models/compile_joints.h"
#include "models/scene.h"
#include "solver/system_builder.h"

namespace wishbone {

/// Puts the signals of a scene, its loads and its drives of joints into a SystemBuilder that has its bodies
/// and joints.
void add_loads(const Scene& scene, JointCompiler& joints, SystemBuilder& builder);

}  // namespace wishbone
