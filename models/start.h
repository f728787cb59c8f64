#pragma once

#include "core/error.h"
#include "models/scene.h"
#include "solver/system.h"
#include "solver/system_builder.h"

namespace wishbone {

/// Finds where a compiled scene starts, whatever the form of its bodies and the cuts of its joints: as the rigid one does that
/// has nothing pinned, where bodies are carried along by all joints that the loops leave to carry (`start_tree`). Flexible bodies
/// start undeformed; where the rigid ones cannot be closed or move so, their deflections must. Given positions of joints that close loops
/// hold while the pose is closed.
///
/// `builder` has built `system`, and numbers its bodies as the scene does.
/// @param warnings takes speeds that contradict each other unless the flexible bodies deform
/// @throws InputError naming given positions of joints that close loops and cannot be closed
void set_start(const Scene& scene, const SystemBuilder& builder, const System& system, State& initial,
               Warnings& warnings);

}  // namespace wishbone
