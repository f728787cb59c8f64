#pragma once

#include "models/scene.h"
#include "solver/system_builder.h"

namespace wishbone {

/// Checks that the matrices of `output.recovery` have a column for each mode of their bodies, which are known when these are
/// built.
/// @throws InputError naming the place in the scene file
void check_recoveries(const Scene& scene, const SystemBuilder& builder, const System& system);

}  // namespace wishbone
