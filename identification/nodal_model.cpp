#include "identification/nodal_model.h"

#include <fmt/format.h>

#include "core/error.h"
#include "identification/methods/stiffness_from_modes.h"

namespace wishbone {

NodalModel nodal_model(const ModeSet& modes) {
  const int complete = 3 * modes.node_count() - 6;
  if (modes.mode_count() != complete)
    throw InputError(
        {"nodal form",
         fmt::format("the nodal form of {} nodes needs all {} modes", modes.node_count(), complete),
         fmt::format("{} modes", modes.mode_count()), "keep all modes, or use the modal form"});
  const SparseMatrix M = lumped_mass_matrix(modes.node_mass);
  NodalModel model{modes.node_ids, modes.node_mass, modes.node_position, {}, {}};
  model.stiffness = stiffness_from_modes({modes.omega.cwiseAbs2(), modes.shapes}, M);
  if (modes.damping_ratio.cwiseAbs().maxCoeff() > 0)
    model.damping =
        stiffness_from_modes({2 * modes.damping_ratio.cwiseProduct(modes.omega), modes.shapes}, M);
  return model;
}

}  // namespace wishbone
