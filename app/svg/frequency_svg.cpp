#include "app/svg/frequency_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/svg/svg.h"
#include "app/svg/text_width.h"
#include "core/error.h"

namespace wishbone {
namespace {

constexpr double kTitleSize = 15;
constexpr double kWidth = 594, kHeight = 260;
constexpr double kLeft = 56, kRight = 12, kTop = 54, kBottom = 44;
constexpr const char* kSoft = "#566070";

/// What is drawn of one mode.
struct Deviation {
  double percent = NAN;  ///< NaN: no reference mode
  double bar = 0;        ///< standard deviation [%]
};

std::vector<Deviation> deviations(const Judgement& judgement) {
  const VectorX& error = judgement.reference->frequency_error;
  std::vector<Deviation> out(static_cast<std::size_t>(error.size()));
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    out[i].percent = 100 * error[i];
    if (i < judgement.frequency_std_hz.size() && i < judgement.frequency_hz.size())
      out[i].bar = 100 * judgement.frequency_std_hz[i] / judgement.frequency_hz[i];
    if (!std::isfinite(out[i].bar)) out[i].bar = 0;
  }
  return out;
}

/// 1, 2 or 5 times a power of ten: at least `least`.
double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/// Paper coordinates of mode numbers (from 0) and percents.
struct Axes {
  double count, limit;  ///< modes; percent at the upper edge

  double x(double mode) const {
    return kLeft + (mode + 0.5) * (kWidth - kLeft - kRight) / std::max(count, 1.0);
  }
  double y(double percent) const { return kTop + (1 - percent / limit) * (kHeight - kTop - kBottom) / 2; }
};

Axes axes_of(const std::vector<Deviation>& all) {
  double largest = 0;
  for (const Deviation& d : all)
    if (std::isfinite(d.percent)) largest = std::max(largest, std::abs(d.percent) + d.bar);
  return {static_cast<double>(all.size()), largest > 0 ? 1.15 * largest : 1};
}

SvgElement scales(const Axes& axes) {
  SvgElement group = svg_group({{"font-size", 11}});
  const double step = round_step(axes.limit / 3);
  for (int k = -static_cast<int>(axes.limit / step); k * step <= axes.limit; ++k) {
    const double y = axes.y(k * step);
    group.add(svg_line({kLeft, y}, {kWidth - kRight, y}, {{"stroke", k == 0 ? "#566070" : "#e3e7ec"}}));
    group.add(svg_text({kLeft - 8, y + 4}, fmt::format("{:g}", k * step), {{"text-anchor", "end"}}));
  }
  const auto stride = static_cast<int>(round_step(std::max(1.0, axes.count / 25)));
  for (int mode = stride - 1; mode < axes.count; mode += stride)
    group.add(svg_text({axes.x(mode), kHeight - kBottom + 17}, fmt::format("{}", mode + 1),
                       {{"text-anchor", "middle"}}));
  if (stride >= 5) group.add(svg_text({axes.x(0), kHeight - kBottom + 17}, "1", {{"text-anchor", "middle"}}));
  group.add(svg_text({kLeft, kHeight - 8}, "mode", {{"font-size", 12}, {"fill", kSoft}}));
  return group.add(svg_text({0, kTop - 14}, "error [%]", {{"font-size", 12}, {"fill", kSoft}}));
}

SvgElement mark(const Axes& axes, double mode, const Deviation& d) {
  constexpr double kCap = 3;
  const double x = axes.x(mode);
  if (!std::isfinite(d.percent)) {
    const Point at(x, kHeight - kBottom);
    return svg_path(path_through({at + Point(-3, -3), at + Point(3, 3)}) +
                        path_through({at + Point(-3, 3), at + Point(3, -3)}),
                    {{"stroke", "#d8571e"}, {"stroke-width", 1.3}});
  }
  SvgElement group = svg_group({{"stroke", "#2f7fc6"}, {"stroke-width", 1.3}});
  if (d.bar > 0)
    for (const double end : {d.percent - d.bar, d.percent + d.bar}) {
      group.add(svg_line({x, axes.y(d.percent)}, {x, axes.y(end)}));
      group.add(svg_line({x - kCap, axes.y(end)}, {x + kCap, axes.y(end)}));
    }
  return group.add(svg_circle({x, axes.y(d.percent)}, 3,
                              {{"fill", "#2f7fc6"}, {"stroke", "#fff"}, {"stroke-width", 0.7}}));
}

/// What the marks mean that are there.
SvgElement legend(const std::vector<Deviation>& all) {
  std::string text;
  if (std::any_of(all.begin(), all.end(), [](const Deviation& d) { return d.bar > 0; }))
    text = "bars: ± one standard deviation";
  if (std::any_of(all.begin(), all.end(), [](const Deviation& d) { return !std::isfinite(d.percent); }))
    text += text.empty() ? "× no reference mode" : "; × no reference mode";
  return svg_text({kWidth - kRight, kHeight - 8}, text, {{"text-anchor", "end"}, {"fill", kSoft}});
}

}  // namespace

std::string frequency_svg(const Judgement& judgement) {
  if (!judgement.reference)
    throw InputError({"frequency picture", "there are no reference frequencies to compare with", "",
                      "judge the identification against a reference"});
  const std::vector<Deviation> all = deviations(judgement);
  const Axes axes = axes_of(all);
  const std::string title = "Frequency error against " + judgement.reference->name;
  SvgElement picture = svg_picture(kWidth, kHeight, title);
  picture.add(svg_text({0, 14}, fitted(title, kTitleSize, kWidth),
                       {{"font-size", kTitleSize}, {"font-weight", 600}}));
  picture.add(scales(axes));
  for (std::size_t i = 0; i < all.size(); ++i) picture.add(mark(axes, static_cast<double>(i), all[i]));
  picture.add(legend(all));
  return picture.markup() + '\n';
}

}  // namespace wishbone
