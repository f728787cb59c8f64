#include "app/svg/mac_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/svg/color_map.h"
#include "app/svg/svg.h"
#include "app/svg/text_width.h"
#include "core/error.h"

namespace wishbone {
namespace {

constexpr double kTitleSize = 15, kWidestTitle = 580;
constexpr double kLabelSize = 10.5;
constexpr double kGap = 6;
constexpr const char* kSoft = "#566070";
constexpr const char* kLine = "#e3e7ec";

/// Where the parts of the picture lie.
struct Layout {
  double cell = 0;     ///< side of a cell [px]
  Point corner, size;  ///< of the matrix
  double width = 0, height = 0;

  Point cell_corner(Eigen::Index row, Eigen::Index column) const {
    return corner + cell * Point(static_cast<double>(column), static_cast<double>(row));
  }
};

Layout layout(const MatrixX& mac, const MacAxis& rows, const MacAxis& columns, const std::string& title) {
  constexpr double kMatrix = 460, kSmallestCell = 4, kLargestCell = 40;
  constexpr double kTitle = 40, kName = 20, kBar = 64;
  Layout out;
  const auto longest = static_cast<double>(std::max<Eigen::Index>({mac.rows(), mac.cols(), 1}));
  out.cell = std::clamp(kMatrix / longest, kSmallestCell, kLargestCell);
  out.size = out.cell * Point(static_cast<double>(mac.cols()), static_cast<double>(mac.rows()));
  out.corner = Point(kName + widest(rows.labels, kLabelSize) + kGap, kTitle);
  out.width =
      std::max(out.corner.x() + out.size.x() + kBar, std::min(text_width(title, kTitleSize), kWidestTitle));
  const double below = widest(columns.labels, kLabelSize) + kGap + kName;
  // the names of the axes need their length even beside a small matrix
  const double beside = std::max(out.size.y(), text_width(rows.name, 12));
  out.width = std::max(out.width, out.corner.x() + text_width(columns.name, 12));
  out.height = out.corner.y() + std::max(out.size.y() + below, beside + kGap);
  return out;
}

SvgElement cells(const MatrixX& mac, const Layout& at) {
  constexpr double kVisible = 0.005;
  SvgElement group = svg_group({{"shape-rendering", "crispEdges"}});
  for (Eigen::Index i = 0; i < mac.rows(); ++i)
    for (Eigen::Index j = 0; j < mac.cols(); ++j) {
      const double value = mac(i, j);
      if (std::isfinite(value) && value < kVisible) continue;
      group.add(svg_rectangle(at.cell_corner(i, j), {at.cell, at.cell},
                              {{"fill", std::isfinite(value) ? kShareColors.at(value) : "#d5d9df"}}));
    }
  return group;
}

/// ".97", "1", "0"; a dash for what is not a number.
std::string short_value(double value) {
  if (!std::isfinite(value)) return "–";
  const std::string text = fmt::format("{:.2f}", value);
  if (text == "0.00" || text == "-0.00") return "0";
  if (text == "1.00") return "1";
  return text.substr(text[0] == '0' ? 1 : 0);
}

SvgElement values(const MatrixX& mac, const Layout& at) {
  const double size = std::min(10.5, 0.42 * at.cell);
  SvgElement group = svg_group({{"font-size", size}, {"text-anchor", "middle"}});
  for (Eigen::Index i = 0; i < mac.rows(); ++i)
    for (Eigen::Index j = 0; j < mac.cols(); ++j) {
      const std::string text = short_value(mac(i, j));
      const char* color = mac(i, j) > 0.5 ? "#fff" : text == "0" ? "#b3bac4" : "#1c2430";
      group.add(svg_text(at.cell_corner(i, j) + Point(at.cell / 2, at.cell / 2 + 0.36 * size), text,
                         {{"fill", color}}));
    }
  return group;
}

/// Lines between the cells where they are large enough, and the frame.
SvgElement grid(const MatrixX& mac, const Layout& at) {
  constexpr double kSmallestGrid = 8;
  SvgElement group = svg_group({{"stroke", kLine}, {"stroke-width", 0.75}});
  if (at.cell >= kSmallestGrid) {
    for (Eigen::Index i = 1; i < mac.rows(); ++i)
      group.add(svg_line(at.cell_corner(i, 0), at.cell_corner(i, mac.cols())));
    for (Eigen::Index j = 1; j < mac.cols(); ++j)
      group.add(svg_line(at.cell_corner(0, j), at.cell_corner(mac.rows(), j)));
  }
  return group.add(
      svg_rectangle(at.corner, at.size, {{"fill", "none"}, {"stroke", kSoft}, {"stroke-width", 1}}));
}

SvgElement row_labels(const MacAxis& rows, const Layout& at, std::size_t stride) {
  SvgElement group = svg_group({{"font-size", kLabelSize}, {"text-anchor", "end"}});
  for (std::size_t i = 0; i < rows.labels.size(); i += stride)
    group.add(svg_text(at.cell_corner(static_cast<Eigen::Index>(i), 0) + Point(-kGap, at.cell / 2 + 3.7),
                       rows.labels[i]));
  return group;
}

/// Upright text that reads upwards and ends at `at`.
SvgElement turned(const Point& at, const std::string& text, const SvgAttributes& more = {}) {
  SvgAttributes attributes = more;
  attributes.push_back({"transform", "rotate(-90 " + svg_number(at.x()) + ' ' + svg_number(at.y()) + ')'});
  return svg_text(at, text, attributes);
}

SvgElement column_labels(const MacAxis& columns, const Layout& at, std::size_t stride) {
  SvgElement group = svg_group({{"font-size", kLabelSize}, {"text-anchor", "end"}});
  for (std::size_t j = 0; j < columns.labels.size(); j += stride)
    group.add(turned(at.corner + Point((static_cast<double>(j) + 0.5) * at.cell + 3.7, at.size.y() + kGap),
                     columns.labels[j]));
  return group;
}

SvgElement axis_names(const MacAxis& rows, const MacAxis& columns, const Layout& at) {
  SvgElement group = svg_group({{"font-size", 12}, {"fill", kSoft}});
  group.add(turned({12, at.corner.y()}, rows.name, {{"text-anchor", "end"}}));
  const double below = at.corner.y() + at.size.y() + kGap + widest(columns.labels, kLabelSize) + 14;
  return group.add(svg_text({at.corner.x(), below}, columns.name));
}

SvgElement color_bar(const Layout& at) {
  constexpr int kPieces = 40;
  constexpr double kWidth = 10, kLowest = 60;
  const double height = std::max(at.size.y(), kLowest), piece = height / kPieces;
  const Point corner = at.corner + Point(at.size.x() + 20, 0);
  SvgElement bar = svg_group({{"font-size", kLabelSize}, {"shape-rendering", "crispEdges"}});
  for (int i = 0; i < kPieces; ++i)
    bar.add(svg_rectangle(corner + Point(0, i * piece), {kWidth, piece + (i + 1 < kPieces ? 0.5 : 0)},
                          {{"fill", kShareColors.at(1 - (i + 0.5) / kPieces)}}));
  bar.add(
      svg_rectangle(corner, {kWidth, height}, {{"fill", "none"}, {"stroke", kSoft}, {"stroke-width", 0.75}}));
  for (const double value : {0.0, 0.5, 1.0})
    bar.add(svg_text(corner + Point(kWidth + 5, (1 - value) * height + 3.7), fmt::format("{:g}", value)));
  return bar;
}

void check_labels(const MatrixX& mac, const MacAxis& rows, const MacAxis& columns) {
  if (static_cast<Eigen::Index>(rows.labels.size()) != mac.rows() ||
      static_cast<Eigen::Index>(columns.labels.size()) != mac.cols())
    throw InputError({"MAC picture", "there must be a label for every row and column",
                      fmt::format("{} x {} labels for {} x {} values", rows.labels.size(),
                                  columns.labels.size(), mac.rows(), mac.cols()),
                      "give the frequency of each mode"});
}

}  // namespace

std::string mac_svg(const MatrixX& mac, const MacAxis& rows, const MacAxis& columns,
                    const std::string& title) {
  constexpr double kLabelPitch = 12;
  constexpr Eigen::Index kMostValues = 20;
  check_labels(mac, rows, columns);
  const Layout at = layout(mac, rows, columns, title);
  const auto stride = static_cast<std::size_t>(std::ceil(kLabelPitch / at.cell));
  SvgElement picture = svg_picture(at.width, at.height, title);
  picture.add(svg_text({0, 18}, fitted(title, kTitleSize, at.width),
                       {{"font-size", kTitleSize}, {"font-weight", 600}}));
  picture.add(cells(mac, at));
  if (std::max(mac.rows(), mac.cols()) <= kMostValues) picture.add(values(mac, at));
  picture.add(grid(mac, at));
  picture.add(row_labels(rows, at, stride));
  picture.add(column_labels(columns, at, stride));
  picture.add(axis_names(rows, columns, at));
  picture.add(color_bar(at));
  return picture.markup() + '\n';
}

}  // namespace wishbone
