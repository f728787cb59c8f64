#pragma once

#include <string>
#include <vector>

namespace wishbone {

/// True when the whole signal path matches the pattern: `*` any characters (slashes too), `?` one, `[abc]`
/// one of.
bool matches(const std::string& pattern, const std::string& path);

/// True when one of the patterns matches.
bool matches_any(const std::vector<std::string>& patterns, const std::string& path);

}  // namespace wishbone
