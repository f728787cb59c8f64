#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/error.h"

namespace wishbone {

/// Checks one number of an element when it is built.
/// @throws InputError naming the element, the rule, the value and the remedy unless `ok`.
inline void require(bool ok, std::string_view element, std::string_view rule, double value,
                    std::string_view remedy) {
  if (ok) return;
  throw InputError({std::string(element), std::string(rule), fmt::format("{}", value), std::string(remedy)});
}

}  // namespace wishbone
