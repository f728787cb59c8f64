#include "bench/curve_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/svg/svg.h"
#include "app/svg/text_width.h"

namespace wishbone::bench {
namespace {

constexpr double kWidth = 760, kPanel = 270, kHead = 56;
constexpr double kLeft = 56, kRight = 14, kTop = 30, kBottom = 42;  // within a panel
constexpr double kTextSize = 12;
constexpr const char* kSoft = "#566070";

struct Style {
  const char* color;
  double width;
  const char* dashes;
};
constexpr std::array<Style, 5> kStyles{{{"#9aa3ae", 5, "none"},
                                        {"#d8571e", 1.4, "none"},
                                        {"#3a9b5c", 1.4, "6 3"},
                                        {"#2f7fc6", 1.6, "none"},
                                        {"#8a4fb3", 1.4, "2 3"}}};

SvgAttributes stroke_of(std::size_t curve) {
  const Style& style = kStyles.at(curve);
  return {{"fill", "none"},
          {"stroke", style.color},
          {"stroke-width", style.width},
          {"stroke-dasharray", style.dashes},
          {"stroke-linejoin", "round"}};
}

/// 1, 2 or 5 times a power of ten, five to ten of which make up the range.
double step_of(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 5)));
  for (const double factor : {5.0, 2.0})
    if (range >= 5 * factor * power) return factor * power;
  return power;
}

struct Range {
  double low, high;

  void include(const VectorX& values) {
    low = std::min(low, values.minCoeff());
    high = std::max(high, values.maxCoeff());
  }
};

/// Paper coordinates of one panel whose upper edge is at `top`.
struct Axes {
  double top;
  Range x_range, y_range;

  double bottom() const { return top + kPanel - kBottom; }
  double x(double value) const {
    return kLeft + (value - x_range.low) / (x_range.high - x_range.low) * (kWidth - kLeft - kRight);
  }
  double y(double value) const {
    return bottom() - (value - y_range.low) / (y_range.high - y_range.low) * (kPanel - kTop - kBottom);
  }
};

Axes axes_of(const Panel& panel, double top) {
  Range x{1e300, -1e300}, y{1e300, -1e300};
  for (const Curve& curve : panel.curves) {
    x.include(curve.x);
    y.include(curve.y);
  }
  const double margin = 0.05 * (y.high - y.low);
  return {top, x, {y.low - margin, y.high + margin}};
}

std::string label(double value) {
  return fmt::format("{:.6g}", value == 0 ? 0 : value);  // no -0
}

SvgElement scales(const Axes& axes, const Panel& panel) {
  SvgElement group = svg_group({{"font-size", 11.5}});
  const auto [x_low, x_high] = axes.x_range;
  const double x_step = step_of(x_high - x_low);
  for (double k = std::ceil(x_low / x_step - 1e-9); k * x_step <= x_high * (1 + 1e-9); ++k)
    group.add(
        svg_text({axes.x(k * x_step), axes.bottom() + 16}, label(k * x_step), {{"text-anchor", "middle"}}));
  const auto [y_low, y_high] = axes.y_range;
  const double y_step = step_of(y_high - y_low);
  for (double k = std::ceil(y_low / y_step); k * y_step <= y_high; ++k) {
    const double y = axes.y(k * y_step);
    group.add(svg_line({kLeft, y}, {kWidth - kRight, y}, {{"stroke", k == 0 ? kSoft : "#e3e7ec"}}));
    group.add(svg_text({kLeft - 8, y + 4}, label(k * y_step), {{"text-anchor", "end"}}));
  }
  group.add(
      svg_text({kLeft, axes.top + kTop - 10}, panel.title, {{"font-size", kTextSize}, {"fill", kSoft}}));
  return group.add(svg_text({kWidth - kRight, axes.bottom() + 33}, panel.x_title,
                            {{"text-anchor", "end"}, {"font-size", kTextSize}, {"fill", kSoft}}));
}

SvgElement line_of(const Axes& axes, const Curve& curve, std::size_t number) {
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < curve.x.size(); ++i)
    points.emplace_back(axes.x(curve.x[i]), axes.y(curve.y[i]));
  return svg_path(path_through(points), stroke_of(number));
}

SvgElement legend(const std::vector<Curve>& curves) {
  constexpr double kSample = 26;
  SvgElement group = svg_group({{"font-size", kTextSize}});
  double x = kLeft;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    group.add(svg_path(path_through({{x, kHead - 18}, {x + kSample, kHead - 18}}), stroke_of(i)));
    group.add(svg_text({x + kSample + 6, kHead - 14}, curves[i].name));
    x += kSample + 20 + text_width(curves[i].name, kTextSize);
  }
  return group;
}

}  // namespace

std::string curve_picture(const std::string& title, const std::vector<Panel>& panels) {
  SvgElement picture = svg_picture(kWidth, kHead + kPanel * static_cast<double>(panels.size()), title);
  picture.add(svg_text({kLeft, 18}, title, {{"font-size", 15}, {"font-weight", 600}}));
  picture.add(legend(panels.at(0).curves));
  double top = kHead;
  for (const Panel& panel : panels) {
    const Axes axes = axes_of(panel, top);
    picture.add(scales(axes, panel));
    for (std::size_t i = 0; i < panel.curves.size(); ++i) picture.add(line_of(axes, panel.curves[i], i));
    top += kPanel;
  }
  return picture.markup() + '\n';
}

}  // namespace wishbone::bench
