#pragma once

#include <string>
#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// One side of a MAC matrix.
struct MacAxis {
  std::string name;                 ///< "identified [Hz]"
  std::vector<std::string> labels;  ///< one a row or column
};

/// The modal assurance criterion of every pair of modes as a heat map, first row on top: white is 0, dark blue
/// 1. Values stand in the cells up to 20 x 20 (two decimals, ".97"); of many labels every second, third ... is
/// written. A value that is not finite becomes a grey cell. Throws InputError when the labels do not fit the
/// matrix.
std::string mac_svg(const MatrixX& mac, const MacAxis& rows, const MacAxis& columns,
                    const std::string& title);

}  // namespace wishbone
