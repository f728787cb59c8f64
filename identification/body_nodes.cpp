#include "identification/body_nodes.h"

#include "core/error.h"

namespace wishbone {

BodyNodes body_nodes(const IdentificationTask& task) {
  const bool expanded = task.coverage == Coverage::kSerep || task.coverage == Coverage::kStatic;
  if (expanded && !task.model)
    throw InputError({"flexible body", "an expansion needs a model", "none was given", "name its M and K"});
  const std::vector<int>& ids = expanded ? task.model->node_ids : task.measured.node_ids;
  const Matrix3X& position = expanded ? task.model->node_position : task.measured.node_position;
  VectorX mass = expanded ? task.model->node_mass : task.measured.node_mass;
  if (task.rigid_body) return {ids, position.colwise() - task.rigid_body->centre};
  if (mass.size() == 0)
    throw InputError({"flexible body", "the masses of its nodes are not known", "",
                      "give a column 'mass' with the nodes, a table of masses, or mass, centre and inertia"});
  for (const Support::Mass& change : task.change.masses) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (ids[i] == change.node) mass[static_cast<Eigen::Index>(i)] += change.mass;
  }
  return {ids, position.colwise() - position * mass / mass.sum()};
}

}  // namespace wishbone
