#pragma once

#include <string>
#include <vector>

#include "app/difference.h"
#include "app/sections.h"
#include "solver/result_file.h"

namespace wishbone {

/// Two files side by side.
struct Comparison {
  CommonTime common_time;
  std::vector<Section> sections;
  std::vector<Difference> differences;    ///< channels of the sections that both files have, in order
  std::vector<std::string> only_in_a;     ///< signals (of the choice) that B lacks
  std::vector<std::string> only_in_b;     ///< signals (of the choice) that A lacks
  std::vector<std::string> incomparable;  ///< signals whose shape or unit differs, and how
};

/// Throws InputError when the files have no time in common or when the globs match nothing.
Comparison compare(const ResultFile& a, const ResultFile& b, const Choice& choice);

}  // namespace wishbone
