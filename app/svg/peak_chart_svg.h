#pragma once

#include <array>
#include <string>

#include "core/spatial.h"

namespace wishbone {

/// The greatest value of each of many numbers of one kind in two runs, such as the energies of modes.
struct PeakChart {
  std::string title;
  std::string unit;
  std::string things = "mode";    ///< what is counted along the axis
  std::array<VectorX, 2> values;  ///< of run A and B; empty: the run has none
};

/// Pairs of bars in the colours --a and --b of the page on a logarithmic scale, whose six decades end above the largest value:
/// values further below, zeros and what is not finite have no bar.
std::string peak_chart_svg(const PeakChart& chart);

}  // namespace wishbone
