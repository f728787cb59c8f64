#include "app/svg/color_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace wishbone {

const ColorMap kDisplacementColors({0x273699, 0x4139a0, 0x583ba6, 0x6d3ea8, 0x8140a6, 0x9542a3, 0xa7459d,
                                    0xba4895, 0xca4d8b, 0xd9527f, 0xe55a71, 0xf06462, 0xf86e50, 0xfe7b3a,
                                    0xff8924, 0xfd9802});

const ColorMap kShareColors({0xffffff, 0xe3f3ff, 0xc8e8ff, 0xaddcfe, 0x92cfff, 0x7bc3fc, 0x65b4f7, 0x54a7f0,
                             0x449ae8, 0x388cde, 0x2e7dd2, 0x2971c4, 0x2564b5, 0x2357a4, 0x224c91, 0x21407d});

std::string ColorMap::at(double value) const {
  const double place = std::clamp(value, 0.0, 1.0) * (anchors_.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), anchors_.size() - 2);
  const double share = place - static_cast<double>(below);
  std::string color = "#";
  for (const int shift : {16, 8, 0}) {
    const double low = (anchors_[below] >> shift) & 0xff, high = (anchors_[below + 1] >> shift) & 0xff;
    color += fmt::format("{:02x}", std::lround(low + share * (high - low)));
  }
  return color;
}

}  // namespace wishbone
