#pragma once

#include <optional>

#include "identification/prepared_structure.h"

namespace wishbone {

/// The noise that a task is worked with: that which was given; where no scatter of the shapes was given, what the modes
/// themselves show (methods/shape_scatter.h). Nothing where that is of rounding size (below 0.001 %), or too large to be
/// scatter (10 % or more), which is told. Modes that were expanded or reduced are combinations of few shapes, of which
/// the law of independent errors does not hold: they show nothing.
///
/// `fitted`: number of masses that were fitted to the orthogonality of the modes. Adds notes and warnings.
std::optional<MeasurementNoise> noise_of(const IdentificationTask& task, PreparedStructure& structure,
                                         int fitted);

}  // namespace wishbone
