#include "app/option_value.h"

#include <fmt/core.h>

namespace wishbone {

double positive_value(const std::string& option, const std::string& text, const Dimension& dimension) {
  double value = 0;
  try {
    value = parse_quantity(text, dimension);
  } catch (const InputError& e) {
    throw InputError({option, e.diagnostic().what, e.diagnostic().value, e.diagnostic().remedy});
  }
  if (!(value > 0))
    throw InputError({option, "the value must be greater than 0", "'" + text + "'",
                      fmt::format("give a positive {} [{}]", dimension.name, dimension.unit)});
  return value;
}

}  // namespace wishbone
