#pragma once

#include "models/compile_modes.h"

namespace wishbone {

/// Prints on standard error what should be doubted of the modes of a scene's bodies, identified or chosen, a line each:
/// "warning: BODY: ...".
void print_warnings(const std::vector<IdentifiedBody>& identified, const std::vector<BodyModes>& chosen);

}  // namespace wishbone
