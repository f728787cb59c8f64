#include "identification/flexible_modes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "identification/fixed_interface_modes.h"
#include "identification/methods/attachment_modes.h"
#include "identification/methods/constraint_modes.h"
#include "identification/normal_modes.h"

namespace wishbone {
namespace {

/// Rows of x, y, z of the nodes.
std::vector<int> freedoms_of(const std::vector<int>& nodes, const AnalyticalModel& model) {
  std::vector<int> freedoms;
  for (const int node : nodes) {
    const auto found = std::find(model.node_ids.begin(), model.node_ids.end(), node);
    if (found == model.node_ids.end())
      throw InputError({"flexible body", "the body has no such node", fmt::format("node {}", node),
                        "name nodes of the body"});
    const int first = 3 * static_cast<int>(found - model.node_ids.begin());
    for (int axis = 0; axis < 3; ++axis) freedoms.push_back(first + axis);
  }
  return freedoms;
}

MatrixX attachment_shapes(const AnalyticalModel& model, const MatrixX& rigid, const std::vector<int>& nodes) {
  if (nodes.empty()) return MatrixX(model.K.rows(), 0);
  return attachment_modes(model.K, model.M, rigid, freedoms_of(nodes, model));
}

MatrixX constraint_shapes(const AnalyticalModel& model, const MatrixX& rigid, const std::vector<int>& nodes) {
  if (nodes.empty()) return MatrixX(model.K.rows(), 0);
  return constraint_modes(model.K, rigid, freedoms_of(nodes, model));
}

ChosenModes no_modes(const AnalyticalModel& model) {
  return {{VectorX(0), MatrixX(model.K.rows(), 0)}, {}};
}

ChosenModes held_modes(const AnalyticalModel& model, const ModeChoice& choice,
                       const std::vector<int>& nodes) {
  if (nodes.empty())
    throw InputError({"flexible body", "modes with held interfaces need interfaces", "none",
                      "join the body to others at nodes or frames, or name nodes under 'constraint'"});
  return fixed_interface_modes(model, choice, freedoms_of(nodes, model));
}

}  // namespace

FlexibleModes flexible_modes(const AnalyticalModel& model, const ModeChoice& normal,
                             const std::vector<int>& attachment_nodes,
                             const std::vector<int>& constraint_nodes, NormalModes of) {
  if (model.node_mass.size() == 0)
    throw InputError({"flexible body", "its masses must be lumped", "a mass matrix that is not lumped",
                      "lump it: 'lumping: row_sum' or 'lumping: diagonal'"});
  FlexibleModes result;
  ModeSet& set = result.set;
  set.node_ids = model.node_ids;
  set.node_mass = model.node_mass;
  const Vector3 centre = model.node_position * model.node_mass / model.node_mass.sum();
  set.node_position = model.node_position.colwise() - centre;

  const bool held = of == NormalModes::of_held_interfaces;
  const ChosenModes kept = held ? no_modes(model) : normal_modes(model, normal);
  const MatrixX rigid = rigid_body_modes(set.node_mass, set.node_position);
  const MatrixX attachment = attachment_shapes(model, rigid, attachment_nodes);
  const MatrixX constraint = constraint_shapes(model, rigid, constraint_nodes);
  const ChosenModes fixed_interface = held ? held_modes(model, normal, constraint_nodes) : no_modes(model);
  CombinedModes all =
      combined_modes(model.K, model.M, rigid, kept, attachment, constraint, fixed_interface.shapes);
  if (all.modes.count() == 0)
    throw InputError({"flexible body", "no mode is chosen", describe(normal),
                      "raise the limit, or write 'modes: none' for a rigid body"});
  set.omega = all.modes.lambda.cwiseSqrt();
  set.shapes = std::move(all.modes.shapes);
  set.damping_ratio = VectorX::Zero(set.omega.size());
  result.kinds = std::move(all.kinds);
  result.left_out = all.left_out;
  result.split = held ? fixed_interface.split : kept.split;
  return result;
}

}  // namespace wishbone
