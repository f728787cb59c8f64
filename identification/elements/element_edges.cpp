#include "identification/elements/element_edges.h"

#include <algorithm>
#include <set>

namespace wishbone {

std::vector<std::array<int, 2>> element_edges(const Mesh& mesh) {
  const ReferenceElement& reference = reference_element(mesh.type);
  std::set<std::array<int, 2>> columns;
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const auto add = [&](int a, int b) {
      const auto [low, high] = std::minmax({mesh.elements(a, e), mesh.elements(b, e)});
      columns.insert({low, high});
    };
    int middle = reference.corners();
    for (const auto& [a, b] : reference.edges) {
      if (!reference.is_quadratic()) {
        add(a, b);
        continue;
      }
      add(a, middle);
      add(middle++, b);
    }
  }
  std::vector<std::array<int, 2>> edges;
  edges.reserve(columns.size());
  for (const auto& [a, b] : columns) edges.push_back({mesh.node_ids[a], mesh.node_ids[b]});
  return edges;
}

}  // namespace wishbone
