#pragma once

#include <vector>

#include "models/scene.h"

namespace wishbone {

/// The nodes of a body that joints, closures, springs and loads of the scene take hold of, those of frames among
/// them, and those of rigid frames whether held or not, for forces keep them together; ascending, each once.
/// Signals and outputs, which only look, do not count.
std::vector<int> interface_nodes(const Scene& scene, int body);

}  // namespace wishbone
