#pragma once

#include "models/compile.h"

namespace wishbone {

/// Prints on standard error what should be doubted of the modes that were identified for a scene, a line each:
/// "warning: BODY: ...".
void print_warnings(const CompiledScene& compiled);

}  // namespace wishbone
