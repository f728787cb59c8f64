#include "app/scene_warnings.h"

#include <fmt/core.h>

namespace wishbone {

void print_warnings(const std::vector<IdentifiedBody>& identified, const std::vector<BodyModes>& chosen) {
  for (const IdentifiedBody& body : identified)
    for (const std::string& warning : body.identification.judgement.warnings)
      fmt::print(stderr, "warning: {}: {}\n", body.body, warning);
  for (const BodyModes& body : chosen)
    for (const std::string& warning : body.warnings)
      fmt::print(stderr, "warning: {}: {}\n", body.body, warning);
}

}  // namespace wishbone
