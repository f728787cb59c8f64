#include "identification/formats/uff_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "identification/formats/uff_mode_sets.h"
#include "identification/formats/uff_systems.h"
#include "identification/methods/real_modes.h"

namespace wishbone {
namespace {

constexpr double kAlong = 1e-6;      ///< cosines below count as zero: axes of a file have six digits
constexpr double kCollinear = 0.95;  ///< MPC below is reported mode by mode
using Motion = Eigen::Vector3cd;     ///< of a node, components in the axes of its shapes

/// Nodes that all modes know, with the axes of their components.
struct KnownNode {
  int number = 0;
  Matrix3 axes = Matrix3::Identity();  ///< columns: axes of the components in global ones
  std::bitset<3> measured;             ///< components that some mode moves
};

// ---- which nodes, in which axes -----------------------------------------------------------------------------

void check_positions(const UffFile& file, const std::vector<UffModeSet>& modes, const std::string& where) {
  std::unordered_set<int> known;
  for (const UffNode& node : file.nodes) known.insert(node.number);
  std::vector<int> missing;
  for (const UffModeSet& mode : modes)
    std::copy_if(mode.nodes.begin(), mode.nodes.end(), std::back_inserter(missing),
                 [&](int node) { return !known.contains(node); });
  if (missing.empty()) return;
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  throw InputError({where, fmt::format("{} nodes of the mode shapes have no position", missing.size()),
                    fmt::format("node {}{}; the file holds {}", missing[0],
                                missing.size() > 1 ? " and others" : "", describe(file)),
                    "export the geometry into the same file (dataset 15 or 2411)"});
}

bool has_local_system(const UffFile& file, const UffNode& node) {
  return node.displacement_system != 0 &&
         !is_undefined_global(file.coordinate_systems, node.displacement_system);
}

bool is_in_displacement_systems(const UffFile& file, const std::vector<UffModeSet>& modes, UffShapeAxes axes,
                                const std::string& where) {
  if (axes != UffShapeAxes::kByDataset) return axes == UffShapeAxes::kDisplacementSystems;
  const int dataset = modes.front().parts.front()->dataset;
  const bool is_mixed = std::any_of(modes.begin(), modes.end(), [&](const UffModeSet& mode) {
    return std::any_of(mode.parts.begin(), mode.parts.end(),
                       [&](auto* part) { return part->dataset != dataset; });
  });
  const bool has_local = std::any_of(file.nodes.begin(), file.nodes.end(),
                                     [&](const UffNode& node) { return has_local_system(file, node); });
  if (is_mixed && has_local)
    throw InputError({where, "modes of datasets 55 and 2414 refer to different axes",
                      "displacement systems that are not global",
                      "keep one kind of dataset, or say which axes the shapes have"});
  return dataset == 55;
}

std::vector<KnownNode> known_nodes(const UffFile& file, const std::vector<UffModeSet>& modes, bool in_systems,
                                   const std::string& where) {
  std::map<int, Matrix3> axes_of;
  std::vector<KnownNode> nodes;
  for (const UffNode& node : file.nodes) {
    if (!std::all_of(modes.begin(), modes.end(),
                     [&](const auto& mode) { return mode.nodes.contains(node.number); }))
      continue;
    const int system = in_systems ? node.displacement_system : 0;
    if (!axes_of.contains(system)) axes_of[system] = uff_frame(file.coordinate_systems, system, where).axes;
    nodes.push_back({node.number, axes_of[system], {}});
  }
  return nodes;
}

// ---- what moves ---------------------------------------------------------------------------------------------

/// Translations of all nodes in one mode: 3 x n, components in the axes of the shapes.
Eigen::Matrix3Xcd motions(const UffModeSet& mode, const std::unordered_map<int, Eigen::Index>& column_of,
                          std::size_t node_count) {
  Eigen::Matrix3Xcd d = Eigen::Matrix3Xcd::Zero(3, static_cast<Eigen::Index>(node_count));
  for (const UffShape* part : mode.parts) {
    const std::size_t step = part->is_complex ? 2 : 1;
    const std::size_t per_node = static_cast<std::size_t>(part->values_per_node) * step;
    for (std::size_t i = 0; i < part->nodes.size(); ++i) {
      const auto column = column_of.find(part->nodes[i]);
      if (column == column_of.end()) continue;
      const double* values = part->values.data() + i * per_node;
      for (std::size_t axis = 0; axis < 3; ++axis)
        d(static_cast<Eigen::Index>(axis), column->second) = {
            values[axis * step], part->is_complex ? values[axis * step + 1] : 0.0};
    }
  }
  return d;
}

/// Components that are zero in every mode count as not measured: files hold three for each node, known or not.
void mark_measured(std::vector<KnownNode>& nodes, const std::vector<Eigen::Matrix3Xcd>& d) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const auto& mode : d)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        if (mode(axis, static_cast<Eigen::Index>(i)) != 0.0)
          nodes[i].measured.set(static_cast<std::size_t>(axis));
}

/// Whether the global axis has a part in a measured component.
bool is_moved(const KnownNode& node, int axis) {
  for (int local = 0; local < 3; ++local)
    if (node.measured[static_cast<std::size_t>(local)] && std::abs(node.axes(axis, local)) > kAlong)
      return true;
  return false;
}

/// Measured along some axes only, and they are not global ones: components across are taken as zero.
bool is_skew(const KnownNode& node) {
  if (node.measured.none() || node.measured.all()) return false;
  for (int local = 0; local < 3; ++local)
    if (node.measured[static_cast<std::size_t>(local)] &&
        node.axes.col(local).cwiseAbs().maxCoeff() < 1 - kAlong)
      return true;
  return false;
}

struct Row {
  std::size_t node;
  int axis;
};

std::vector<Row> rows_of(const std::vector<KnownNode>& nodes) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (is_moved(nodes[i], axis)) rows.push_back({i, axis});
  return rows;
}

Eigen::VectorXcd global_shape(const Eigen::Matrix3Xcd& d, const std::vector<KnownNode>& nodes,
                              const std::vector<Row>& rows) {
  Eigen::VectorXcd shape(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& axes = nodes[rows[k].node].axes;
    shape[static_cast<Eigen::Index>(k)] =
        (axes.row(rows[k].axis).cast<std::complex<double>>() * d.col(static_cast<Eigen::Index>(rows[k].node)))
            .value();
  }
  return shape;
}

/// Real shapes stay as they are, complex ones become real.
VectorX real_shape(const Eigen::VectorXcd& psi, const UffModeSet& mode, std::size_t number,
                   std::vector<std::string>& provenance) {
  if (!mode.is_complex) return psi.real();
  const Eigen::VectorXcd s = Eigen::VectorXcd::Constant(1, std::complex<double>(0, mode.omega));
  const RealModes real = real_modes(s, psi);
  if (real.phase_collinearity[0] < kCollinear)
    provenance.push_back(fmt::format(
        "mode {} at {:.6g} Hz is complex: phase collinearity {:.3f}, {:.1f} % left in the imaginary part",
        number, mode.omega / (2 * EIGEN_PI), real.phase_collinearity[0], 100 * real.imaginary_share[0]));
  return real.shapes.col(0);
}

// ---- what to say about it -----------------------------------------------------------------------------------

void say_axes(const UffFile& file, const std::vector<KnownNode>& nodes, bool in_systems,
              std::vector<std::string>& provenance) {
  const auto local = std::count_if(file.nodes.begin(), file.nodes.end(),
                                   [&](const UffNode& node) { return has_local_system(file, node); });
  if (local > 0)
    provenance.push_back(
        fmt::format("{} nodes have displacement coordinate systems: shapes {}", local,
                    in_systems ? "were turned from them into global axes" : "were taken as global"));
  const auto skew = std::count_if(nodes.begin(), nodes.end(), is_skew);
  if (skew > 0)
    provenance.push_back(fmt::format(
        "{} nodes were measured along axes that are not global, in one or two of them: zero across", skew));
}

void say_freedoms(const UffFile& file, const std::vector<UffModeSet>& modes, std::size_t node_count,
                  std::size_t row_count, std::vector<std::string>& provenance) {
  const bool has_rotations = std::any_of(
      modes.begin(), modes.end(), [](const auto& mode) { return mode.parts.front()->values_per_node == 6; });
  if (has_rotations) provenance.push_back("left out the rotations of shapes of six values per node");
  std::unordered_set<int> some;
  for (const UffModeSet& mode : modes) some.insert(mode.nodes.begin(), mode.nodes.end());
  if (some.size() > node_count)
    provenance.push_back(
        fmt::format("left out {} nodes that some modes do not know", some.size() - node_count));
  if (row_count < 3 * node_count)
    provenance.push_back(
        fmt::format("{} freedoms are zero in every mode: taken as not measured", 3 * node_count - row_count));
  if (some.size() < file.nodes.size())
    provenance.push_back(
        fmt::format("{} nodes have a position and no shape", file.nodes.size() - some.size()));
}

}  // namespace

UffModes collect_uff_modes(const UffFile& file, UffShapeAxes axes, const std::string& where) {
  UffModes modes;
  const std::vector<UffModeSet> sets = uff_mode_sets(file, modes.provenance);
  if (sets.empty()) {
    std::string why = describe(file);
    for (const std::string& line : modes.provenance) why += "; " + line;
    throw InputError({where, "the file holds no modes", why,
                      "export mode shapes at nodes (dataset 55 or 2414, analysis type 2, 3 or 7)"});
  }
  check_positions(file, sets, where);
  const bool in_systems = is_in_displacement_systems(file, sets, axes, where);
  std::vector<KnownNode> nodes = known_nodes(file, sets, in_systems, where);
  std::unordered_map<int, Eigen::Index> column_of;
  for (std::size_t i = 0; i < nodes.size(); ++i) column_of[nodes[i].number] = static_cast<Eigen::Index>(i);
  std::vector<Eigen::Matrix3Xcd> d;
  for (const UffModeSet& set : sets) d.push_back(motions(set, column_of, nodes.size()));
  mark_measured(nodes, d);
  const std::vector<Row> rows = rows_of(nodes);
  if (rows.empty())
    throw InputError({where, "no node moves in every mode", fmt::format("{} modes", sets.size()),
                      "export all modes for the same nodes"});
  for (const Row& row : rows) modes.freedoms.push_back({nodes[row.node].number, row.axis});

  const auto m = static_cast<Eigen::Index>(sets.size());
  modes.omega.resize(m);
  modes.damping_ratio.resize(m);
  modes.modal_mass.resize(m);
  modes.shapes.resize(static_cast<Eigen::Index>(rows.size()), m);
  for (std::size_t j = 0; j < sets.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    modes.omega[k] = sets[j].omega;
    modes.damping_ratio[k] = sets[j].damping_ratio;
    modes.modal_mass[k] = sets[j].modal_mass;
    modes.shapes.col(k) = real_shape(global_shape(d[j], nodes, rows), sets[j], j + 1, modes.provenance);
  }
  say_axes(file, nodes, in_systems, modes.provenance);
  say_freedoms(file, sets, nodes.size(), rows.size(), modes.provenance);
  return modes;
}

std::string describe(const UffFile& file) {
  std::vector<std::string> parts;
  const auto say = [&](std::size_t count, std::string_view one, std::string_view many) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
  };
  say(file.nodes.size(), "node", "nodes");
  say(file.coordinate_systems.size(), "coordinate system", "coordinate systems");
  say(file.trace_lines.size(), "trace line", "trace lines");
  say(file.elements.size(), "element", "elements");
  say(file.shapes.size(), "nodal result", "nodal results");
  say(file.functions.size(), "function", "functions");
  say(file.unused.size(), "dataset that is not read", "datasets that are not read");
  return parts.empty() ? "nothing that is read" : fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace wishbone
