#include "app/warnings.h"

#include <fmt/core.h>

namespace wishbone {

void print_warnings(const Warnings& warnings) {
  for (const Diagnostic& warning : warnings) fmt::print(stderr, "{}\n", warning.warning());
}

}  // namespace wishbone
