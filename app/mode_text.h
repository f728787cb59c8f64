#pragma once

#include <string>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// A number with `digits` significant digits and never an exponent, for columns that are read downwards; a dash
/// when it is not known (not finite).
std::string significant_text(double value, int digits);

/// A share in percent: two decimals, or two significant digits below 0.01 %; a dash when it is not finite.
std::string percent_text(double share);

/// "Mode 3 · 17.35 Hz · ζ 1.2 %"; no damping where it is zero. `mode` counts from 0.
std::string mode_title(const ModalData& data, int mode);

/// [Hz]
VectorX frequencies_hz(const VectorX& omega);

/// "3 · 17.35" for every mode, counted from 1: number and frequency.
std::vector<std::string> mode_labels(const VectorX& hz);

}  // namespace wishbone
