#pragma once

#include <cstddef>

#include "identification/formats/uff/uff_file.h"
#include "identification/formats/uff/uff_input.h"

namespace wishbone {

/// How the numbers of a function follow each other.
struct UffLayout {
  std::size_t points = 0;
  bool is_even = true;
  bool is_complex = false;
  bool is_double = false;

  std::size_t ordinates_per_point() const { return is_complex ? 2 : 1; }
  std::size_t numbers_per_point() const { return ordinates_per_point() + (is_even ? 0 : 1); }
};

/// Records 1 to 11 of dataset 58 or 58b: all of `function` but its values.
UffLayout read_uff_function_heading(UffInput& in, UffFunction& function);

}  // namespace wishbone
