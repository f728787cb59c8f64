#include "identification/mode_set_of.h"

#include <fmt/format.h>

#include <utility>

#include "core/error.h"
#include "identification/methods/modes.h"

namespace wishbone {
namespace {

/// Rows of x, y, z of every node, node by node.
std::vector<int> rows_by_node(const ModalData& modes) {
  std::vector<int> rows;
  for (const Freedom& freedom : all_freedoms(modes.node_ids)) {
    const auto row = modes.row(freedom);
    if (!row)
      throw InputError({"flexible body", "its modes must show every node in x, y and z",
                        to_string(freedom) + " is missing",
                        "expand the measurement to a model (expansion: serep or static)"});
    rows.push_back(*row);
  }
  return rows;
}

}  // namespace

ModeSet mode_set_of(const ModalData& modes) {
  if (!modes.support.empty())
    throw InputError({"flexible body", "its modes must be free-free", "modes on a support",
                      "identify the free-free modes (find: free)"});
  if (!modes.has_masses())
    throw InputError({"flexible body", "it needs a mass at every node",
                      "masses unknown, or a mass matrix that is not lumped",
                      "give a column 'mass' with the nodes, or mass, centre and inertia"});
  const std::vector<int> rows = rows_by_node(modes);
  ModeSet set;
  set.node_ids = modes.node_ids;
  set.node_mass = modes.node_mass;
  const Vector3 centre = modes.node_position * modes.node_mass / modes.node_mass.sum();
  set.node_position = modes.node_position.colwise() - centre;
  set.omega = modes.omega;
  set.damping_ratio = modes.damping_ratio;
  set.shapes = mass_normalised({modes.omega.cwiseAbs2(), modes.shapes(rows, Eigen::all)},
                               lumped_mass_matrix(modes.node_mass))
                   .shapes;
  set.validate();
  return set;
}

ModalData modal_data_of(const ModeSet& set, std::string title) {
  ModalData data;
  data.title = std::move(title);
  data.node_ids = set.node_ids;
  data.node_position = set.node_position;
  data.node_mass = set.node_mass;
  data.freedoms = all_freedoms(set.node_ids);
  data.omega = set.omega;
  data.damping_ratio = set.damping_ratio;
  data.modal_mass = VectorX::Ones(set.mode_count());
  data.shapes = set.shapes;
  return data;
}

}  // namespace wishbone
