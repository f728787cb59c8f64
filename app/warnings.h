#pragma once

#include "core/error.h"

namespace wishbone {

/// Prints on standard error what should be doubted: "WHERE: warning: WHAT (got VALUE)" and the remedy.
void print_warnings(const Warnings& warnings);

}  // namespace wishbone
