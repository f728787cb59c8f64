// What truncated sets of modes cost in precision: the chassis freed from springs and from joints.
#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <vector>

#include "identification/elements/mesh.h"
#include "identification/free_free_modes.h"
#include "identification/methods/clean_up.h"
#include "identification/methods/joint_support.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/residual.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/spring_support.h"
#include "identification/methods/support_matrices.h"
#include "identification/modal_data.h"

namespace {

using namespace wishbone;

struct Chassis {
  Mesh mesh = make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation);
  IsotropicMaterial material{2.1e8, 0.3, 2600};
  std::vector<Freedom> freedoms = all_freedoms(mesh.node_ids);
  SparseMatrix M = lumped_mass_matrix(lumped_mass(mesh, material.density));
  SparseMatrix K = stiffness_matrix(mesh, material);
  MatrixX rigid = rigid_body_basis(rigid_body_shapes(freedoms, mesh.node_ids, mesh.nodes), M);
  VectorX free_hz = free_free_modes(mesh, material).omega / (2 * 3.14159265358979323846);
};

Support springs(double stiffness) {
  Support support;
  for (const int node : {1, 2, 17, 18})
    for (int axis = 0; axis < 3; ++axis) support.springs.push_back({node, Vector3::Unit(axis), stiffness});
  return support;
}

Support joints() {
  Support support;
  for (const auto& [node, axis] : {std::pair{1, 0}, {1, 1}, {1, 2}, {18, 1}, {2, 2}, {17, 2}})
    support.joints.push_back({node, Vector3::Unit(axis)});
  return support;
}

/// Largest error of the lowest `count` frequencies in percent; fewer when there are fewer.
double worst_percent(const VectorX& found, const VectorX& truth, Eigen::Index count) {
  count = std::min({count, found.size(), truth.size()});
  return 100 * (found.head(count).array() / truth.head(count).array() - 1).abs().maxCoeff();
}

/// A complete set has nothing to estimate but rounding.
double shown(double estimate) {
  return estimate < 1e-12 ? 0 : estimate;
}

/// The source's modes of the free structure, its rigid-body modes dropped, each space for itself.
VectorX by_the_source(const Chassis& c, const SupportMatrices& support, const Modes& given, Space space) {
  if (support.D.rows() > 0) return release_from_joints(given, c.M, support.D, c.rigid).frequency_hz();
  const VectorX f = release_from_springs(space, given, c.M, support.M_s, support.K_s).frequency_hz();
  return f.tail(f.size() - 6);
}

void print_row(const Chassis& c, const std::string& name, const Support& held, Eigen::Index kept) {
  const SupportMatrices support = support_matrices(held, c.freedoms);
  const Modes given = model_modes(c.K, c.M, support).lowest(kept);
  const ReleasedModes released = release(given, c.M, support, c.rigid);
  const VectorX f = released.modes.frequency_hz();
  const VectorX estimate =
      100 * frequency_error_estimate(released.modes.lambda, released.residual, given.lambda.maxCoeff());
  const VectorX physical = by_the_source(c, support, given, Space::kPhysical);
  const VectorX modal = by_the_source(c, support, given, Space::kModal);
  const double difference = (physical.array() / modal.array() - 1).abs().maxCoeff();
  fmt::print("| {} | {} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {} |\n", name, kept, f.size(),
             worst_percent(f, c.free_hz, 3), worst_percent(f, c.free_hz, 1000),
             shown(estimate.head(std::min<Eigen::Index>(3, f.size())).maxCoeff()),
             worst_percent(modal, c.free_hz, 3), worst_percent(modal, c.free_hz, 1000),
             support.D.rows() > 0 ? "" : fmt::format("{:.0e}", difference));
}

}  // namespace

int main() {
  const Chassis chassis;
  fmt::print(
      "| support | modes measured | modes found | error of the lowest 3 [%] | of all [%] | estimate for the "
      "lowest 3 "
      "[%] | source: lowest 3 [%] | of all [%] | physical against modal space "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const int kept : {10, 20, 27, 60})
    for (const double k : {1e2, 1e3, 1e4, 47e3, 1e5, 1e6, 1e7, 1e8})
      print_row(chassis, fmt::format("springs {:.3g} N/m", k), springs(k), kept);
  for (const int kept : {10, 20, 27, 54}) print_row(chassis, "joints", joints(), kept);
}
