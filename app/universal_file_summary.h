#pragma once

#include <nlohmann/json.hpp>

#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// What is in a Universal File, for people: origin, units, counts, nodal results, functions, and what is not read.
void print_universal_file(const UffFile& file);

/// The same for programs; every function is listed.
nlohmann::ordered_json json_of(const UffFile& file);

}  // namespace wishbone
