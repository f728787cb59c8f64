#include "identification/mode_table.h"

#include <numbers>

namespace wishbone {

std::vector<ModeRow> mode_table(const ModeSet& set, const std::vector<ModeKind>& kinds,
                                const std::vector<int>& nodes) {
  const std::vector<int>& felt_at = nodes.empty() ? set.node_ids : nodes;
  std::vector<ModeRow> rows;
  for (int j = 0; j < set.mode_count(); ++j) {
    double largest = 0;  // |Psi_i|^2
    int node = felt_at.front();
    for (const int id : felt_at) {
      const double square = set.shapes.col(j).segment<3>(3 * set.node_index(id)).squaredNorm();
      if (square <= largest) continue;
      largest = square;
      node = id;
    }
    rows.push_back({kinds[static_cast<std::size_t>(j)], set.omega[j] / (2 * std::numbers::pi),
                    set.damping_ratio[j], 1 / largest, node});
  }
  return rows;
}

std::vector<ModeKind> inherited_kinds(const ModeSet& combined, const ModeSet& from,
                                      const std::vector<ModeKind>& kinds) {
  const MatrixX parts =
      from.omega.asDiagonal() *
      (from.shapes.transpose() * mass_of_freedoms(from.node_mass).asDiagonal() * combined.shapes);
  std::vector<ModeKind> inherited;
  for (const auto& part : parts.colwise()) inherited.push_back(largest_share(part.cwiseAbs2(), kinds));
  return inherited;
}

}  // namespace wishbone
