#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/yaml_node.h"

namespace wishbone {

/// Reads a document made of one file and those that it includes, with everything resolved:
///  * `include: other.yaml` (or a list, relative to the including file) merges the sections of the other file
///  name by
///    name; a name given in two files is an error, a file included twice is read once;
///  * `parameters` (core/parameters.h) take their values, `overrides` ("name=value") last;
///  * a scalar that begins with `=` is replaced by its value;
///  * a mapping `{select: PARAMETER, a: ..., b: ...}` is replaced by the branch that the parameter's value
///  names; an empty
///    branch leaves the entry out;
///  * an entry or item `{repeat: {i: [FIRST, LAST]}, ...}` is written once for every i, which its expressions
///  may use and its texts and keys as `{i}`.
/// Throws InputError.
YamlNodePtr load_document(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

}  // namespace wishbone
