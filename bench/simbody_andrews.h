#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/work_precision.h"

namespace wishbone::bench {

/// Andrews' mechanism with Debian's Simbody: a line of runs for each of its integrators. Defined where it is installed.
std::vector<std::pair<std::string, std::vector<Precision>>> simbody_andrews();

}  // namespace wishbone::bench
