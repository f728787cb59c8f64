#include "identification/formats/uff/uff_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <string_view>

#include "core/error.h"
#include "identification/formats/uff/uff_known_nodes.h"
#include "identification/formats/uff/uff_mode_sets.h"
#include "identification/methods/real_modes.h"

namespace wishbone {
namespace {

constexpr double kCollinear = 0.95;  ///< MPC below is reported mode by mode

using Rows = std::vector<UffKnownNodes::Row>;

[[noreturn]] void refuse_no_modes(const UffFile& file, const std::vector<std::string>& provenance,
                                  const std::string& where) {
  std::string holds = describe(file);
  for (const std::string& line : provenance) holds += "; " + line;
  throw InputError({where, "the file holds no modes", holds,
                    "export mode shapes at nodes (dataset 55 or 2414, analysis type 2, 3 or 7)"});
}

Eigen::VectorXcd global_shape(const UffMotions& d, const UffKnownNodes& nodes, const Rows& rows) {
  Eigen::VectorXcd shape(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::RowVector3d along = nodes[rows[k].node].axes.row(rows[k].axis);
    shape[static_cast<Eigen::Index>(k)] =
        along.cast<std::complex<double>>() * d.col(static_cast<Eigen::Index>(rows[k].node));
  }
  return shape;
}

/// Real shapes stay as they are, complex ones become real.
VectorX real_shape(const Eigen::VectorXcd& psi, const UffModeSet& mode, std::size_t number,
                   std::vector<std::string>& provenance) {
  if (!mode.is_complex) return psi.real();
  const RealModes real = real_modes(Eigen::VectorXcd::Constant(1, std::complex<double>(0, mode.omega)), psi);
  if (real.phase_collinearity[0] < kCollinear)
    provenance.push_back(fmt::format(
        "mode {} at {:.6g} Hz is complex: phase collinearity {:.3f}, {:.1f} % left in the imaginary part",
        number, mode.omega / (2 * std::numbers::pi), real.phase_collinearity[0],
        100 * real.imaginary_share[0]));
  return real.shapes.col(0);
}

bool has_rotations(const UffModeSet& mode) {
  return std::any_of(mode.parts.begin(), mode.parts.end(),
                     [](auto* part) { return part->values_per_node == 6; });
}

}  // namespace

UffModes collect_uff_modes(const UffFile& file, UffShapeAxes axes, const std::string& where) {
  UffModes modes;
  const std::vector<UffModeSet> sets = uff_mode_sets(file, modes.provenance);
  if (sets.empty()) refuse_no_modes(file, modes.provenance, where);
  const UffKnownNodes nodes(file, sets, axes, where);
  const Rows rows = nodes.rows();
  if (rows.empty())
    throw InputError({where, "no node moves in every mode", fmt::format("{} modes", sets.size()),
                      "export all modes for the same nodes"});
  for (const auto& row : rows) modes.freedoms.push_back({nodes[row.node].number, row.axis});

  const auto m = static_cast<Eigen::Index>(sets.size());
  modes.omega.resize(m);
  modes.damping_ratio.resize(m);
  modes.modal_mass.resize(m);
  modes.shapes.resize(static_cast<Eigen::Index>(rows.size()), m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const UffModeSet& set = sets[static_cast<std::size_t>(j)];
    modes.omega[j] = set.omega;
    modes.damping_ratio[j] = set.damping_ratio;
    modes.modal_mass[j] = set.modal_mass;
    modes.shapes.col(j) = real_shape(global_shape(nodes.motions(set), nodes, rows), set,
                                     static_cast<std::size_t>(j + 1), modes.provenance);
  }
  if (std::any_of(sets.begin(), sets.end(), has_rotations))
    modes.provenance.push_back("left out the rotations of shapes of six values per node");
  nodes.say(modes.provenance);
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
