#pragma once

#include <string>
#include <vector>

#include "models/scene.h"

namespace wishbone {

/// The scene file `path`, those that it includes, as far as something in the scene comes from them, and the files of data that
/// it reads: none of them may be overwritten by what is made of the scene.
std::vector<std::string> input_files(const std::string& path, const Scene& scene);

}  // namespace wishbone
