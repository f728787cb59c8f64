#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace wishbone {

/// Length of the well-formed UTF-8 sequence at the start of `s`, which is not empty; 0 when there is none (Unicode 15, table
/// 3-7: no overlong forms, no surrogates, nothing beyond U+10FFFF).
std::size_t utf8_length(std::string_view s);

/// Valid UTF-8: as it is if it is valid, else with every byte beyond ASCII taken as Latin-1.
std::string as_utf8(std::string_view bytes);

}  // namespace wishbone
