#include "identification/formats/uff/uff_known_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <unordered_set>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr double kAlong = 1e-6;  ///< cosines below count as zero: axes of a file have six digits

/// How many modes know each node.
std::unordered_map<int, std::size_t> counts_of(const std::vector<UffModeSet>& modes) {
  std::unordered_map<int, std::size_t> counts;
  for (const UffModeSet& mode : modes)
    for (const UffShape* part : mode.parts)
      for (const int node : part->nodes) ++counts[node];
  return counts;
}

void check_positions(const UffFile& file, const std::unordered_map<int, std::size_t>& counts,
                     const std::string& where) {
  std::unordered_set<int> known;
  for (const UffNode& node : file.nodes) known.insert(node.number);
  std::vector<int> missing;
  for (const auto& [node, count] : counts)
    if (!known.contains(node)) missing.push_back(node);
  if (missing.empty()) return;
  throw InputError(
      {where, fmt::format("{} nodes of the mode shapes have no position", missing.size()),
       fmt::format("node {}{}; the file holds {}", *std::min_element(missing.begin(), missing.end()),
                   missing.size() > 1 ? " and others" : "", describe(file)),
       "export the geometry into the same file (dataset 15 or 2411)"});
}

bool is_in_displacement_systems(const std::vector<UffModeSet>& modes, UffShapeAxes axes, bool has_local_axes,
                                const std::string& where) {
  if (axes != UffShapeAxes::kByDataset) return axes == UffShapeAxes::kDisplacementSystems;
  const int dataset = modes.front().parts.front()->dataset;
  const bool is_mixed = std::any_of(modes.begin(), modes.end(), [&](const UffModeSet& mode) {
    return std::any_of(mode.parts.begin(), mode.parts.end(),
                       [&](auto* part) { return part->dataset != dataset; });
  });
  if (is_mixed && has_local_axes)
    throw InputError({where, "modes of datasets 55 and 2414 refer to different axes",
                      "displacement systems that are not global", "keep one kind of dataset"});
  return dataset == 55;
}

/// Measured along some axes only, and they are not global ones: components across are taken as zero.
bool is_skew(const UffKnownNodes::Node& node) {
  if (node.measured.none() || node.measured.all()) return false;
  for (int local = 0; local < 3; ++local)
    if (node.measured[static_cast<std::size_t>(local)] &&
        node.axes.col(local).cwiseAbs().maxCoeff() < 1 - kAlong)
      return true;
  return false;
}

}  // namespace

UffKnownNodes::UffKnownNodes(const UffFile& file, const std::vector<UffModeSet>& modes, UffShapeAxes axes,
                             const std::string& where) {
  const std::unordered_map<int, std::size_t> counts = counts_of(modes);
  check_positions(file, counts, where);
  UffSystems systems(file.coordinate_systems, where);
  in_local_axes_ = std::count_if(file.nodes.begin(), file.nodes.end(), [&](const UffNode& node) {
    return !systems.is_global(node.displacement_system);
  });
  in_systems_ = is_in_displacement_systems(modes, axes, in_local_axes_ > 0, where);
  in_some_modes_ = counts.size();
  without_shape_ = file.nodes.size() - counts.size();
  for (const UffNode& node : file.nodes) {
    const auto count = counts.find(node.number);
    if (count == counts.end() || count->second < modes.size()) continue;
    column_of_[node.number] = static_cast<Eigen::Index>(nodes_.size());
    const UffFrame& frame = systems.frame(in_systems_ ? node.displacement_system : 0);
    nodes_.push_back({node.number, frame.directions_at(systems.position(node)), {}});
  }
  for (const UffModeSet& mode : modes) {
    const UffMotions d = motions(mode);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (d(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)) != 0.0)
          nodes_[i].measured.set(axis);
  }
}

UffMotions UffKnownNodes::motions(const UffModeSet& mode) const {
  UffMotions d = UffMotions::Zero(3, static_cast<Eigen::Index>(nodes_.size()));
  for (const UffShape* part : mode.parts) {
    const std::size_t step = part->is_complex ? 2 : 1;
    const std::size_t per_node = static_cast<std::size_t>(part->values_per_node) * step;
    for (std::size_t i = 0; i < part->nodes.size(); ++i) {
      const auto column = column_of_.find(part->nodes[i]);
      if (column == column_of_.end()) continue;
      const double* value = part->values.data() + i * per_node;
      for (Eigen::Index axis = 0; axis < 3; ++axis, value += step)
        d(axis, column->second) = {value[0], part->is_complex ? value[1] : 0.0};
    }
  }
  return d;
}

std::vector<UffKnownNodes::Row> UffKnownNodes::rows() const {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      bool is_moved = false;
      for (int local = 0; local < 3; ++local)
        is_moved = is_moved || (nodes_[i].measured[static_cast<std::size_t>(local)] &&
                                std::abs(nodes_[i].axes(axis, local)) > kAlong);
      if (is_moved) rows.push_back({i, axis});
    }
  return rows;
}

void UffKnownNodes::say(std::vector<std::string>& provenance) const {
  if (in_local_axes_ > 0)
    provenance.push_back(
        fmt::format("{} nodes have displacement coordinate systems: shapes {}", in_local_axes_,
                    in_systems_ ? "were turned from them into global axes" : "were taken as global"));
  if (const auto skew = std::count_if(nodes_.begin(), nodes_.end(), is_skew); skew > 0)
    provenance.push_back(fmt::format(
        "{} nodes were measured along axes that are not global, in one or two of them: zero across", skew));
  if (in_some_modes_ > nodes_.size())
    provenance.push_back(
        fmt::format("left out {} nodes that some modes do not know", in_some_modes_ - nodes_.size()));
  if (const std::size_t known = rows().size(); known < 3 * nodes_.size())
    provenance.push_back(
        fmt::format("{} freedoms are zero in every mode: taken as not measured", 3 * nodes_.size() - known));
  if (without_shape_ > 0)
    provenance.push_back(fmt::format("{} nodes have a position and no shape", without_shape_));
}

}  // namespace wishbone
