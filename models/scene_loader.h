#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/scene.h"

namespace wishbone {

/// Reads a scene file and checks everything that can be checked without computing: keys, units, ranges,
/// references, the tree of joints. `overrides` are "name=value" for the file's parameters. The schema is that
/// of docs/scene.md; includes, parameters, expressions and selections are those of core/document.h. Throws
/// InputError with place, value and remedy for the first thing that is wrong.
Scene load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

}  // namespace wishbone
