#include "app/svg/wireframe.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "app/svg/color_map.h"
#include "app/svg/neighbour_lines.h"

namespace wishbone {
namespace {

std::unordered_map<int, int> columns_of(const std::vector<int>& node_ids) {
  std::unordered_map<int, int> columns;
  for (const int id : node_ids) columns.emplace(id, static_cast<int>(columns.size()));
  return columns;
}

/// Fewer pixels for more nodes, so that lines stay apart.
double pen(const Wireframe& frame, double of_few, double of_many) {
  constexpr double kFew = 60, kMany = 400;
  const double share = (static_cast<double>(frame.nodes.cols()) - kFew) / (kMany - kFew);
  return std::lerp(of_few, of_many, std::clamp(share, 0.0, 1.0));
}

/// A line in pieces of one colour each, so that the colour follows the displacement along it.
void add_line(SvgElement& lines, const Point& a, const Point& b, double value_a, double value_b) {
  constexpr double kStep = 0.05;
  const int pieces = 1 + static_cast<int>(std::abs(value_b - value_a) / kStep);
  for (int i = 0; i < pieces; ++i) {
    const double from = static_cast<double>(i) / pieces, to = static_cast<double>(i + 1) / pieces;
    const double value = std::lerp(value_a, value_b, (from + to) / 2);
    lines.add(svg_path(path_through({a + from * (b - a), a + to * (b - a)}),
                       {{"stroke", kDisplacementColors.at(value)}}));
  }
}

}  // namespace

double Wireframe::size() const {
  if (nodes.cols() == 0) return 0;
  return (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
}

Wireframe wireframe(const ModalData& data) {
  constexpr int kMostJoined = 2000;  // joining more takes seconds, and they draw the structure by themselves
  const bool guess = data.lines.empty() && data.node_count() <= kMostJoined;
  Wireframe frame{data.node_position, {}, guess, view_of(data.node_position)};
  const auto columns = columns_of(data.node_ids);
  for (const auto& [a, b] : data.lines) frame.lines.push_back({columns.at(a), columns.at(b)});
  if (guess) frame.lines = neighbour_lines(frame.nodes);
  const auto nearness = [&](const std::array<int, 2>& line) {
    return frame.view.nearness(frame.nodes.col(line[0]) + frame.nodes.col(line[1]));
  };
  std::stable_sort(frame.lines.begin(), frame.lines.end(),
                   [&](const auto& a, const auto& b) { return nearness(a) < nearness(b); });
  return frame;
}

Matrix3X unit_displacement(const ModalData& data, int mode) {
  const auto columns = columns_of(data.node_ids);
  Matrix3X displacement = Matrix3X::Zero(3, data.node_count());
  for (int r = 0; r < data.freedom_count(); ++r)
    displacement(data.freedoms[r].axis, columns.at(data.freedoms[r].node)) = data.shapes(r, mode);
  const double largest = displacement.size() > 0 ? displacement.colwise().stableNorm().maxCoeff() : 0;
  if (largest > 0) displacement /= largest;
  return displacement;
}

SvgElement draw_at_rest(const Wireframe& frame, const Placement& place) {
  std::string data;
  for (const auto& [a, b] : frame.lines)
    data += path_through({place(frame.nodes.col(a)), place(frame.nodes.col(b))});
  SvgElement group = svg_group({{"stroke", "#c3c9d1"}, {"stroke-width", pen(frame, 1.1, 0.6)}});
  if (!data.empty()) group.add(svg_path(data, {{"fill", "none"}, {"stroke-linecap", "round"}}));
  SvgElement dots = svg_group({{"fill", "#c3c9d1"}, {"stroke", "none"}});
  for (const auto& node : frame.nodes.colwise()) dots.add(svg_circle(place(node), pen(frame, 1.8, 0.8)));
  return group.add(dots);
}

SvgElement draw_displaced(const Wireframe& frame, const Matrix3X& displacement, double amplitude,
                          const Placement& place) {
  const Matrix3X displaced = frame.nodes + amplitude * displacement;
  const VectorX value = displacement.colwise().norm();
  SvgElement lines =
      svg_group({{"fill", "none"}, {"stroke-width", pen(frame, 2.2, 1)}, {"stroke-linecap", "round"}});
  for (const auto& [a, b] : frame.lines)
    add_line(lines, place(displaced.col(a)), place(displaced.col(b)), value[a], value[b]);
  SvgElement dots = svg_group({{"stroke", "#fff"}, {"stroke-width", pen(frame, 0.6, 0.2)}});
  for (Eigen::Index i = 0; i < displaced.cols(); ++i)
    dots.add(svg_circle(place(displaced.col(i)), pen(frame, 3.2, 1.3),
                        {{"fill", kDisplacementColors.at(value[i])}}));
  return svg_group().add(lines).add(dots);
}

}  // namespace wishbone
