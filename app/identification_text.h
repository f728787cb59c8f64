#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "identification/identify.h"

namespace wishbone {

/// An identification for a terminal: warnings, table of modes, notes, measures of quality, MAC against the
/// reference.
std::string text_of(const Identification& identification);

/// The same for programs; what is not known is null.
nlohmann::ordered_json json_of(const Identification& identification);

}  // namespace wishbone
