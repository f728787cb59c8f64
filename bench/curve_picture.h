#pragma once

#include <string>
#include <vector>

#include "core/spatial.h"

namespace wishbone::bench {

struct Curve {
  std::string name;
  VectorX x, y;
};

/// Curves over one x axis; later ones lie over earlier ones. Those of one name look alike in all panels.
struct Panel {
  std::string title, x_title;
  std::vector<Curve> curves;
};

/// Panels one above the other, with a legend at the top, as SVG.
std::string curve_picture(const std::string& title, const std::vector<Panel>& panels);

}  // namespace wishbone::bench
