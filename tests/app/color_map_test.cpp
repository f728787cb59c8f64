#include "app/svg/color_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wishbone {
namespace {

/// Lightness L* (CIE 1976) of "#rrggbb", sRGB with white point D65 (IEC 61966-2-1).
double lightness(const std::string& color) {
  const auto linear = [&](int place) {
    const double c = std::stoi(color.substr(place, 2), nullptr, 16) / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double luminance = 0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5);
  return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
}

void expect_even_steps(const ColorMap& map, double from, double to) {
  constexpr int kSteps = 15;
  constexpr double kJustNoticeable = 1;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    EXPECT_NEAR(lightness(map.at(share)), std::lerp(from, to, share), kJustNoticeable) << i;
  }
}

TEST(ColorMap, LightnessFollowsTheValue) {
  expect_even_steps(kDisplacementColors, 28, 72);
  expect_even_steps(kShareColors, 100, 28);
}

TEST(ColorMap, ValuesAreHeldToTheirRange) {
  EXPECT_EQ(kShareColors.at(-1), "#ffffff");
  EXPECT_EQ(kShareColors.at(0), "#ffffff");
  EXPECT_EQ(kShareColors.at(1), kShareColors.at(7));
}

}  // namespace
}  // namespace wishbone
