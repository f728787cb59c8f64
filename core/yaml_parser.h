#pragma once

#include <cstddef>
#include <filesystem>

#include "core/yaml_node.h"

namespace wishbone {

/// What a file may contain; the limits act while it is being parsed, so that hostile or broken files cost
/// little.
struct YamlLimits {
  static constexpr std::size_t kFileBytes = 1 << 20;
  static constexpr std::size_t kDepth = 32;  ///< mappings and lists within one another
  static constexpr std::size_t kAliases = 1000;
  static constexpr std::size_t kNodes = 100'000;  ///< aliases counted with all that they stand for
};

/// Reads one YAML 1.2 document whose root is a mapping. Keys are words and unique; tags, merge keys and
/// several documents in one file are refused. `included_from` is where the file was asked for, for the
/// message when it cannot be opened. Throws InputError with file, line and column.
YamlNodePtr parse_yaml_file(const std::filesystem::path& path, const Source& included_from = {});

}  // namespace wishbone
