#pragma once

#include <optional>
#include <string>

#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// What turns numbers of a file into SI.
struct UffScale {
  double metre = 1;        ///< SI length = file length * metre
  double newton = 1;       ///< SI force = file force * newton
  std::string provenance;  ///< the system of units and where it was taken from

  /// Of masses: F = m a with the second as unit of time in all systems.
  double kilogram() const { return newton / metre; }
};

/// Scale of dataset 164. Its factors count: the file's value divided by the factor is SI. Where they
/// contradict the table of codes (1 m N, 2 ft lbf, 3 m kgf, 4 ft pdl, 5 mm mN, 6 cm cN, 7 in lbf, 8 mm kgf, 9
/// user-defined, 10 mm N) `provenance` says so. Without the dataset, metre and newton are assumed.
UffScale uff_scale(const std::optional<UffUnits>& units);

}  // namespace wishbone
