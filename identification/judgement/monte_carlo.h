#pragma once

#include <functional>

#include "identification/methods/modes.h"

namespace wishbone {

/// Scatter of measured modes, standard deviations of independent normal errors.
struct MeasurementNoise {
  double frequency = 0;  ///< of every frequency, relative [-]
  double shape = 0;      ///< of every component of a shape, relative to the root mean square of the shape [-]
  int samples = 200;     ///< >= 2
  unsigned seed = 1;
};

/// Standard deviation of the frequencies that `identify` finds [Hz], by repeating it on disturbed modes. Modes of a
/// repetition are paired with those of the undisturbed set by their shapes (MAC); a mode that is lost in more than
/// half of the repetitions has NaN. The same seed gives the same bits.
VectorX frequency_deviation(const Modes& measured, const MeasurementNoise& noise,
                            const std::function<Modes(const Modes&)>& identify);

}  // namespace wishbone
