#include "app/svg/peak_chart_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/svg/svg.h"

namespace wishbone {
namespace {

constexpr double kWidth = 594, kHeight = 238;
constexpr double kLeft = 56, kRight = 12, kTop = 8, kBottom = 38;
constexpr int kDecades = 6;
constexpr const char* kSoft = "#667080";

/// Paper coordinates of numbers (counted from 0) and values.
struct Axes {
  double count;  ///< numbers along the axis
  int top;       ///< decade of the upper edge

  double step() const { return (kWidth - kLeft - kRight) / std::max(count, 1.0); }
  double x(double number) const { return kLeft + (number + 0.5) * step(); }
  double y(double decade) const { return kTop + (top - decade) * (kHeight - kTop - kBottom) / kDecades; }
};

Axes axes_of(const PeakChart& chart) {
  double largest = 0;
  for (const VectorX& values : chart.values)
    for (const double value : values)
      if (std::isfinite(value)) largest = std::max(largest, value);
  const double count = static_cast<double>(std::max(chart.values[0].size(), chart.values[1].size()));
  return {count, largest > 0 ? static_cast<int>(std::ceil(std::log10(largest))) : 0};
}

/// Every how many numbers one is written.
int label_stride(double count) {
  constexpr double kMostLabels = 25;
  int stride = 1;
  for (const int factor : {2, 5, 10, 20, 50, 100, 200, 500, 1000})
    if (count / stride > kMostLabels) stride = factor;
  return stride;
}

SvgElement scales(const Axes& axes, const std::string& things) {
  SvgElement group = svg_group({{"font-size", 11.5}, {"fill", kSoft}});
  for (int k = 0; k <= kDecades; ++k) {
    const double y = axes.y(axes.top - k);
    group.add(
        svg_line({kLeft, y}, {kWidth - kRight, y}, {{"stroke", k == kDecades ? "#b9c0c9" : "#dde2e8"}}));
    group.add(svg_text({kLeft - 8, y + 4}, fmt::format("{:g}", std::pow(10.0, axes.top - k)),
                       {{"text-anchor", "end"}}));
  }
  const int stride = label_stride(axes.count);
  for (int number = 0; number < axes.count; number += number == 0 && stride > 1 ? stride - 1 : stride)
    group.add(svg_text({axes.x(number), kHeight - kBottom + 16}, fmt::format("{}", number + 1),
                       {{"text-anchor", "middle"}}));
  return group.add(
      svg_text({(kLeft + kWidth - kRight) / 2, kHeight - 6}, things, {{"text-anchor", "middle"}}));
}

SvgElement bars(const Axes& axes, const VectorX& values, int run) {
  constexpr double kShare = 0.4;  // of the step that one bar takes
  SvgElement group = svg_group({{"style", run == 0 ? "fill:var(--a)" : "fill:var(--b)"}});
  const double foot = axes.y(axes.top - kDecades), width = kShare * axes.step();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double decade = std::log10(values[i]);
    if (!std::isfinite(decade) || decade <= axes.top - kDecades) continue;
    const double y = axes.y(decade), x = axes.x(static_cast<double>(i)) + (run == 0 ? -width : 0);
    group.add(svg_rectangle({x, y}, {width, foot - y}));
  }
  return group;
}

}  // namespace

std::string peak_chart_svg(const PeakChart& chart) {
  const Axes axes = axes_of(chart);
  SvgElement picture = svg_picture(kWidth, kHeight, chart.title);
  picture.add(scales(axes, chart.things));
  for (const int run : {0, 1}) picture.add(bars(axes, chart.values[static_cast<std::size_t>(run)], run));
  return picture.markup() + '\n';
}

}  // namespace wishbone
