#include "identification/formats/uff/uff_elements.h"

#include <algorithm>
#include <span>

namespace wishbone {
namespace {

using Edges = std::vector<std::array<int, 2>>;
using Nodes = std::span<const int>;

/// Through the nodes that are not zero.
void add_chain(Edges& edges, Nodes nodes, bool is_closed) {
  std::vector<int> present;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(present), [](int node) { return node > 0; });
  for (std::size_t k = 0; k + 1 < present.size(); ++k) edges.push_back({present[k], present[k + 1]});
  if (is_closed && present.size() > 2) edges.push_back({present.back(), present.front()});
}

void add_star(Edges& edges, Nodes nodes) {
  for (std::size_t k = 1; k < nodes.size(); ++k) add_chain(edges, std::array{nodes[0], nodes[k]}, false);
}

/// A base loop, middle nodes over its corners, a top loop (or one apex). Corners are `stride` apart in the
/// loops.
struct Solid {
  std::size_t corners;
  std::size_t stride;     ///< 1 linear, 2 parabolic
  bool has_apex = false;  ///< a tetrahedron

  std::size_t loop() const { return corners * stride; }
  std::size_t middles() const { return stride == 2 ? corners : 0; }
  std::size_t count() const { return loop() + middles() + (has_apex ? 1 : loop()); }
};

void add_solid(Edges& edges, Nodes nodes, const Solid& solid) {
  if (nodes.size() != solid.count()) return;
  const Nodes top = nodes.subspan(solid.loop() + solid.middles());
  add_chain(edges, nodes.first(solid.loop()), true);
  if (!solid.has_apex) add_chain(edges, top, true);
  for (std::size_t corner = 0; corner < solid.corners; ++corner) {
    const int middle = solid.stride == 2 ? nodes[solid.loop() + corner] : 0;
    add_chain(
        edges,
        std::array{nodes[corner * solid.stride], middle, top[solid.has_apex ? 0 : corner * solid.stride]},
        false);
  }
}

}  // namespace

bool is_uff_beam(int descriptor) {
  return descriptor == 11 || (descriptor >= 21 && descriptor <= 24);
}

std::vector<std::array<int, 2>> uff_element_edges(const UffElement& element) {
  Edges edges;
  const int kind = element.descriptor;
  if (is_uff_beam(kind) || (kind >= 136 && kind <= 142)) add_chain(edges, element.nodes, false);
  if (kind >= 41 && kind <= 96) add_chain(edges, element.nodes, true);
  if (kind == 121 || kind == 122) add_star(edges, element.nodes);
  if (kind == 111) add_solid(edges, element.nodes, {3, 1, true});
  if (kind == 112) add_solid(edges, element.nodes, {3, 1});
  if (kind == 113) add_solid(edges, element.nodes, {3, 2});
  if (kind == 115) add_solid(edges, element.nodes, {4, 1});
  if (kind == 116) add_solid(edges, element.nodes, {4, 2});
  if (kind == 118) add_solid(edges, element.nodes, {3, 2, true});
  return edges;
}

}  // namespace wishbone
