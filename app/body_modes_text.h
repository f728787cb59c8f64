#pragma once

#include <string>

#include "models/compile_modes.h"

namespace wishbone {

/// A line on what was chosen, and a table of the modes of a flexible body.
std::string text_of(const BodyModes& body);

}  // namespace wishbone
