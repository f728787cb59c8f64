#include "bodies/nodal_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace wishbone {
namespace {

VectorX inverse_root_masses(const NodalModel& model) {
  return mass_of_freedoms(model.node_mass).cwiseSqrt().cwiseInverse();
}

/// Phi = M^-1/2 Q with orthonormal columns Q, and the model's matrices in them.
ShapeSet shapes_in(const NodalModel& model, const MatrixX& Q, bool mean_axes) {
  ShapeSet set;
  set.node_ids = model.node_ids;
  set.node_mass = model.node_mass;
  set.node_position = model.node_position;
  set.shapes = inverse_root_masses(model).asDiagonal() * Q;
  set.stiffness = set.shapes.transpose() * model.stiffness * set.shapes;
  if (model.damping.size() > 0)
    set.damping = set.shapes.transpose() * model.damping * set.shapes;
  else
    set.damping = MatrixX::Zero(Q.cols(), 1);
  set.mean_axes = mean_axes;
  return set;
}

int node_index(const NodalModel& model, int id) {
  const auto found = std::find(model.node_ids.begin(), model.node_ids.end(), id);
  if (found == model.node_ids.end())
    throw InputError({"nodal form", "there is no such node", fmt::format("node {}", id),
                      "fix the axes on nodes of the body"});
  return static_cast<int>(found - model.node_ids.begin());
}

int largest_component(const Vector3& v) {
  int axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// Rows of the six freedoms that the axes are fixed to.
std::array<int, 6> held_freedoms(const NodalModel& model, const std::array<int, 3>& nodes) {
  const int o = node_index(model, nodes[0]), i = node_index(model, nodes[1]), j = node_index(model, nodes[2]);
  const Vector3 d = model.node_position.col(i) - model.node_position.col(o);
  const Vector3 e = model.node_position.col(j) - model.node_position.col(o);
  // turning about d moves j along d x e
  const Vector3 across = d.cross(e);
  if (!(across.norm() > 1e-6 * d.norm() * e.norm()))
    throw InputError({"nodal form", "three nodes to which the axes are fixed must not lie on one line",
                      fmt::format("nodes {}, {}, {}", nodes[0], nodes[1], nodes[2]),
                      "choose nodes that span a plane"});
  // i is kept from moving across the axis along which it is farthest from o
  const int along = largest_component(d);
  return {3 * o,
          3 * o + 1,
          3 * o + 2,
          3 * i + (along + 1) % 3,
          3 * i + (along + 2) % 3,
          3 * j + largest_component(across)};
}

}  // namespace

ShapeSet mean_axis_shapes(const NodalModel& model) {
  return shapes_in(model, elastic_complement(model.node_mass, model.node_position), true);
}

ShapeSet fixed_axis_shapes(const NodalModel& model, const std::array<int, 3>& nodes) {
  const std::array<int, 6> held = held_freedoms(model, nodes);
  const Eigen::Index freedoms = 3 * model.node_mass.size();
  MatrixX Q = MatrixX::Zero(freedoms, freedoms - 6);
  Eigen::Index column = 0;
  for (int row = 0; row < freedoms; ++row)
    if (std::find(held.begin(), held.end(), row) == held.end()) Q(row, column++) = 1;
  return shapes_in(model, Q, false);
}

}  // namespace wishbone
