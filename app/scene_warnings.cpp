#include "app/scene_warnings.h"

#include <fmt/core.h>

namespace wishbone {

void print_warnings(const CompiledScene& compiled) {
  for (const IdentifiedBody& body : compiled.identified)
    for (const std::string& warning : body.identification.judgement.warnings)
      fmt::print(stderr, "warning: {}: {}\n", body.body, warning);
  for (const BodyModes& body : compiled.modes)
    for (const std::string& warning : body.warnings)
      fmt::print(stderr, "warning: {}: {}\n", body.body, warning);
}

}  // namespace wishbone
