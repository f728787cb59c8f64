#include "identification/elements/element_edges.h"

#include <algorithm>
#include <set>

namespace wishbone {

std::vector<std::array<int, 2>> element_edges(const HexahedralMesh& mesh) {
  // corners as Hexahedron orders them: round one face, round the opposite one, and from face to face
  constexpr std::array<std::array<int, 2>, 12> kCorners{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  std::set<std::array<int, 2>> columns;
  for (int e = 0; e < mesh.elements.cols(); ++e)
    for (const auto& [a, b] : kCorners) {
      const auto [low, high] = std::minmax({mesh.elements(a, e), mesh.elements(b, e)});
      columns.insert({low, high});
    }
  std::vector<std::array<int, 2>> edges;
  edges.reserve(columns.size());
  for (const auto& [a, b] : columns) edges.push_back({mesh.node_ids[a], mesh.node_ids[b]});
  return edges;
}

}  // namespace wishbone
