#pragma once

#include "models/scene.h"
#include "solver/system.h"
#include "solver/system_builder.h"

namespace wishbone {

/// Finds where a compiled scene starts, whatever the form of its bodies and the cuts of its joints: as the rigid one does that
/// has nothing pinned, where bodies are carried along by all joints that the loops leave to carry (`start_tree`). Flexible bodies
/// start undeformed; where the rigid ones cannot be closed, their deflections must. Given positions of joints that close loops
/// hold while the pose is closed.
///
/// `builder` has built `system`, and numbers its bodies as the scene does.
/// @throws InputError naming positions that cannot be closed, or speeds that contradict each other
void set_start(const Scene& scene, const SystemBuilder& builder, const System& system, State& initial);

}  // namespace wishbone
