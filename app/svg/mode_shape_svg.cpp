#include "app/svg/mode_shape_svg.h"

#include <fmt/core.h>

#include <algorithm>

#include "app/mode_text.h"
#include "app/svg/color_map.h"
#include "app/svg/support_symbols.h"
#include "app/svg/wireframe.h"
#include "core/error.h"

namespace wishbone {
namespace {

constexpr double kTitle = 40;   ///< height of the line above a structure [px]
constexpr double kLegend = 64;  ///< height of the strip with axes and colours [px]
constexpr const char* kSoft = "#566070";
constexpr double kMargin = 14;   ///< round everything [px]
constexpr double kSupport = 26;  ///< room round the structure for symbols of its support [px]

/// Displacements of some modes, and all places that their nodes take.
struct Motion {
  std::vector<Matrix3X> displacement;  ///< unit
  double amplitude = 0;                ///< [m]
  Matrix3X reached;                    ///< 3 x n (1 + modes)
};

Motion motion(const ModalData& data, const Wireframe& frame, int first, int count, double share) {
  const Eigen::Index n = frame.nodes.cols();
  Motion motion{{}, share * frame.size(), frame.nodes.replicate(1, 1 + count)};
  for (int j = 0; j < count; ++j) {
    motion.displacement.push_back(unit_displacement(data, first + j));
    motion.reached.middleCols((1 + j) * n, n) += motion.amplitude * motion.displacement.back();
  }
  return motion;
}

/// Height of paper for points that are seen over a width: flat enough for rows, high enough for titles.
double height_for(const View& view, const Matrix3X& points, double width) {
  return width * std::clamp(aspect(view, points), 0.2, 0.8);
}

/// Body axes, seen as the structure is.
SvgElement axes_triad(const View& view, const Point& origin) {
  constexpr double kArrow = 28;
  SvgElement triad = svg_group({{"stroke", kSoft}, {"stroke-width", 1.3}, {"font-size", 11}});
  const Matrix3 axes = Matrix3::Identity();
  for (int k = 0; k < 3; ++k) {
    const Point seen = view.project(axes.col(k));
    const Point tip = Point(seen.x(), -seen.y());
    triad.add(svg_line(origin, origin + kArrow * tip));
    triad.add(svg_text(origin + (kArrow * tip.norm() + 8) * tip.normalized() + Point(0, 4),
                       std::string(1, "xyz"[k]),
                       {{"text-anchor", "middle"}, {"stroke", "none"}, {"fill", kSoft}}));
  }
  return triad;
}

SvgElement color_bar(const Point& right_end) {
  constexpr int kPieces = 32;
  const Point size(120, 8), corner = right_end - Point(size.x() + 24, 0);
  const double piece = size.x() / kPieces;
  SvgElement bar = svg_group({{"font-size", 11}, {"shape-rendering", "crispEdges"}});
  for (int i = 0; i < kPieces; ++i)
    bar.add(svg_rectangle(corner + Point(i * piece, 0), {piece + 0.5, size.y()},
                          {{"fill", kDisplacementColors.at((i + 0.5) / kPieces)}}));
  bar.add(svg_text(corner + Point(-6, 8), "displacement 0", {{"text-anchor", "end"}, {"fill", kSoft}}));
  bar.add(svg_text(corner + Point(size.x() + 6, 8), "max", {{"fill", kSoft}}));
  return bar;
}

/// Axes to the left, colours to the right, in a strip under the structure.
void add_legend(SvgElement& picture, const Wireframe& frame, double width, double height) {
  picture.add(axes_triad(frame.view, {kMargin + 24, height - kMargin - 14}));
  if (frame.lines_are_guessed)
    picture.add(svg_text({kMargin + 76, height - kMargin - 2}, "lines join neighbours",
                         {{"font-size", 11}, {"fill", kSoft}}));
  picture.add(color_bar({width - kMargin, height - kMargin - 10}));
}

void add_mode(SvgElement& picture, const ModalData& data, const Wireframe& frame, const Motion& motion, int j,
              const Placement& place) {
  picture.add(draw_at_rest(frame, place));
  picture.add(draw_support(data, frame, place));
  picture.add(draw_displaced(frame, motion.displacement[j], motion.amplitude, place));
}

double room_for_support(const ModalData& data) {
  return data.support.empty() ? 0 : kSupport;
}

}  // namespace

std::string mode_shape_svg(const ModalData& data, int mode, const ModeShapeOptions& options) {
  data.validate();
  if (mode < 0 || mode >= data.mode_count())
    throw InputError({"mode shape", fmt::format("there are {} modes", data.mode_count()),
                      fmt::format("mode {}", mode + 1), "draw one of them"});
  const Wireframe frame = wireframe(data);
  const Motion one = motion(data, frame, mode, 1, options.amplitude);
  const double aside = kMargin + room_for_support(data);
  const double room = options.width - 2 * aside;
  const double drawn = height_for(frame.view, one.reached, room);
  const double height = kTitle + drawn + aside + kLegend;

  SvgElement picture = svg_picture(options.width, height, mode_title(data, mode));
  picture.add(
      svg_text({kMargin, kMargin + 8}, mode_title(data, mode), {{"font-size", 15}, {"font-weight", 600}}));
  const Placement place(frame.view, one.reached, {aside, kTitle}, {room, drawn});
  add_mode(picture, data, frame, one, 0, place);
  add_legend(picture, frame, options.width, height);
  return picture.markup() + '\n';
}

std::string mode_sheet_svg(const ModalData& data, int count) {
  data.validate();
  constexpr int kColumns = 3;
  constexpr double kCellWidth = 405;
  count = std::clamp(count, 0, data.mode_count());
  const int columns = std::clamp(count, 1, kColumns), rows = (count + columns - 1) / columns;
  const Wireframe frame = wireframe(data);
  const Motion all = motion(data, frame, 0, count, ModeShapeOptions{}.amplitude);

  const double aside = kMargin + room_for_support(data);
  const double room = kCellWidth - 2 * aside, drawn = height_for(frame.view, all.reached, room);
  const double cell_height = kTitle + drawn + aside;
  const double width = columns * kCellWidth, height = rows * cell_height + kLegend;
  SvgElement sheet = svg_picture(width, height, data.title.empty() ? "Mode shapes" : data.title);
  for (int j = 0; j < count; ++j) {
    const int row = j / columns, column = j % columns;
    const Point corner(column * kCellWidth, row * cell_height);
    sheet.add(svg_text(corner + Point(kMargin, kMargin + 8), mode_title(data, j),
                       {{"font-size", 13}, {"font-weight", 600}}));
    add_mode(sheet, data, frame, all, j,
             Placement(frame.view, all.reached, corner + Point(aside, kTitle), {room, drawn}));
  }
  add_legend(sheet, frame, width, height);
  return sheet.markup() + '\n';
}

}  // namespace wishbone
