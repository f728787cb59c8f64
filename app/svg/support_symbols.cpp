#include "app/svg/support_symbols.h"

#include <cmath>

namespace wishbone {
namespace {

constexpr double kLength = 20;  ///< of a symbol [px]

/// Paper axes of a symbol at a node: `along` leads from the node to the ground.
struct SymbolAxes {
  Point node, along, across;

  Point operator()(double forth, double aside) const { return node + forth * along + aside * across; }
};

/// From which side a support along u holds a node: from below, else from outside.
double ground_side(const Vector3& u, const Vector3& from_middle) {
  constexpr double kUpright = 0.7;
  if (std::abs(u.z()) > kUpright) return u.z() > 0 ? -1 : 1;
  return u.dot(from_middle) < 0 ? -1 : 1;
}

void add_ground(SvgElement& symbols, const SymbolAxes& at) {
  constexpr double kHalf = 6, kHatch = 3;
  symbols.add(svg_path(path_through({at(kLength, -kHalf), at(kLength, kHalf)})));
  std::string hatches;
  for (int i = 0; i < 4; ++i) {
    const double aside = -kHalf + kHatch * i;
    hatches += path_through({at(kLength, aside + kHatch), at(kLength + kHatch, aside)});
  }
  symbols.add(svg_path(hatches, {{"stroke-width", 0.6}}));
}

void add_spring(SvgElement& symbols, const SymbolAxes& at) {
  std::vector<Point> points{at(0, 0), at(5, 0)};
  for (int i = 0; i < 5; ++i) points.push_back(at(6.2 + 2.2 * i, i % 2 == 0 ? 3 : -3));
  points.insert(points.end(), {at(16.2, 0), at(kLength, 0)});
  symbols.add(svg_path(path_through(points)));
  add_ground(symbols, at);
}

void add_joint(SvgElement& symbols, const SymbolAxes& at) {
  constexpr double kHalf = 5.5;
  symbols.add(
      svg_path(path_through({at(2, 0), at(kLength, -kHalf), at(kLength, kHalf)}) + 'Z', {{"fill", "#fff"}}));
  add_ground(symbols, at);
}

template <class Held>
void add_all(SvgElement& symbols, const ModalData& data, const std::vector<Held>& held,
             const Wireframe& frame, const Placement& place, void (*add)(SvgElement&, const SymbolAxes&)) {
  constexpr double kAlongSight = 0.2;
  if (held.empty()) return;
  const Vector3 middle = frame.nodes.rowwise().mean();
  for (const Held& support : held) {
    const Vector3 position = frame.nodes.col(data.node_index(support.node));
    const Vector3 to_ground = ground_side(support.direction, position - middle) * support.direction;
    const Point seen = frame.view.project(to_ground);
    if (seen.norm() < kAlongSight) {
      symbols.add(svg_circle(place(position), 6));
      continue;
    }
    const Point along = Point(seen.x(), -seen.y()).normalized();
    add(symbols, {place(position), along, Point(-along.y(), along.x())});
  }
}

}  // namespace

SvgElement draw_support(const ModalData& data, const Wireframe& frame, const Placement& place) {
  SvgElement symbols = svg_group({{"fill", "none"}, {"stroke", "#566070"}, {"stroke-linejoin", "round"}});
  add_all(symbols, data, data.support.springs, frame, place, add_spring);
  add_all(symbols, data, data.support.joints, frame, place, add_joint);
  for (const Support::Mass& mass : data.support.masses) {
    const Point at = place(frame.nodes.col(data.node_index(mass.node)));
    symbols.add(svg_rectangle(at - Point(4, 4), {8, 8}, {{"fill", "#566070"}, {"fill-opacity", 0.35}}));
  }
  return symbols;
}

}  // namespace wishbone
