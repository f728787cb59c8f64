#include "identification/held_freedoms.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace wishbone {
namespace {

/// Freedoms that joints along an axis hold, as far as they have no row.
std::vector<Freedom> missing_freedoms(const ModalData& data) {
  std::vector<Freedom> missing;
  for (const Support::Joint& joint : data.support.joints) {
    Eigen::Index axis = 0;
    if (joint.direction.cwiseAbs().maxCoeff(&axis) < 1 - 1e-12) continue;
    const Freedom freedom{joint.node, static_cast<int>(axis)};
    if (!data.row(freedom) && std::find(missing.begin(), missing.end(), freedom) == missing.end())
      missing.push_back(freedom);
  }
  return missing;
}

}  // namespace

ModalData with_held_freedoms(const ModalData& data) {
  const std::vector<Freedom> missing = missing_freedoms(data);
  if (missing.empty()) return data;
  std::map<int, int> place;
  for (int i = 0; i < data.node_count(); ++i) place[data.node_ids[static_cast<std::size_t>(i)]] = i;
  ModalData complete = data;
  complete.freedoms.insert(complete.freedoms.end(), missing.begin(), missing.end());
  std::stable_sort(complete.freedoms.begin(), complete.freedoms.end(),
                   [&](const Freedom& a, const Freedom& b) {
                     return std::tuple(place.at(a.node), a.axis) < std::tuple(place.at(b.node), b.axis);
                   });
  complete.shapes = MatrixX::Zero(complete.freedom_count(), data.mode_count());
  for (int i = 0; i < complete.freedom_count(); ++i)
    if (const auto row = data.row(complete.freedoms[static_cast<std::size_t>(i)]))
      complete.shapes.row(i) = data.shapes.row(*row);
  return complete;
}

}  // namespace wishbone
