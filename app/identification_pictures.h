#pragma once

#include <string>
#include <vector>

#include "identification/identify.h"

namespace wishbone {

/// A picture under the name of its file.
struct Picture {
  std::string name;  ///< "mac_reference.svg"
  std::string svg;
};

/// The pictures of an identification that have something to show: modes.svg and input_modes.svg (the lowest
/// twelve), mac_reference.svg, mac_input.svg, mac_auto.svg, frequencies.svg.
std::vector<Picture> identification_pictures(const Identification& identification);

/// Writes them into a folder, which is made if it does not exist. Throws NumericsError when it cannot write.
void write_pictures(const std::string& folder, const Identification& identification);

}  // namespace wishbone
