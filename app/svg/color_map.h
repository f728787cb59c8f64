#pragma once

#include <array>
#include <string>

namespace wishbone {

/// Colours of a scalar from 0 to 1, linear between sixteen anchors (sRGB) whose lightness (L* of CIE 1976)
/// changes by equal steps: equal differences of the scalar look equal, in grey print too.
class ColorMap {
 public:
  using Anchors = std::array<unsigned, 16>;  ///< 0xrrggbb
  explicit constexpr ColorMap(const Anchors& anchors) : anchors_(anchors) {}

  /// "#rrggbb"; `value` is held to 0 ... 1.
  std::string at(double value) const;

 private:
  Anchors anchors_;
};

/// Blue over magenta to orange, L* from 28 to 72: dark enough for thin lines on white paper.
extern const ColorMap kDisplacementColors;

/// White to dark blue, L* from 100 to 28: for areas; small values fade into the paper.
extern const ColorMap kShareColors;

}  // namespace wishbone
