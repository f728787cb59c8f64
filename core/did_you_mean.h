#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wishbone {

/// Number of single-character insertions, deletions, substitutions and swaps of neighbours that turn `a` into
/// `b` (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// "did you mean 'stiffness'?" when a candidate is near enough to `name` to be what was meant, otherwise
/// "`kind` are: a, b, c", and "there are none" when there is nothing to choose from.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates,
                         std::string_view kind);

}  // namespace wishbone
