#include "bodies/shape_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"

namespace wishbone {
namespace {

bool is_square_or_diagonal(const MatrixX& matrix, Eigen::Index m) {
  return matrix.rows() == m && (matrix.cols() == 1 || matrix.cols() == m);
}

void check_nodes(const ShapeSet& set) {
  const Eigen::Index n = set.node_count(), m = set.shape_count();
  if (n < 3)
    throw InputError({"flexible body", "a flexible body needs at least three nodes", fmt::format("{}", n),
                      "give more nodes"});
  const bool fits =
      set.node_mass.size() == n && set.node_position.cols() == n && set.shapes.rows() == 3 * n &&
      is_square_or_diagonal(set.stiffness, m) && is_square_or_diagonal(set.damping, m) &&
      (set.stiffening.size() == 0 || (set.stiffening.rows() == m && set.stiffening.cols() == 6 * m));
  if (!fits)
    throw InputError(
        {"flexible body",
         fmt::format("{} nodes and {} shapes need {} masses and positions, {} x {} shapes, stiffness and "
                     "damping of {} rows, and {} x {} of stiffening if there is any",
                     n, m, n, 3 * n, m, m, m, 6 * m),
         fmt::format("{} masses, {} positions, {} x {} shapes, stiffness {} x {}, damping {} x {}, "
                     "stiffening {} x {}",
                     set.node_mass.size(), set.node_position.cols(), set.shapes.rows(), set.shapes.cols(),
                     set.stiffness.rows(), set.stiffness.cols(), set.damping.rows(), set.damping.cols(),
                     set.stiffening.rows(), set.stiffening.cols()),
         "give every node and every shape its row and column"});
  if (static_cast<Eigen::Index>(std::set<int>(set.node_ids.begin(), set.node_ids.end()).size()) != n)
    throw InputError(
        {"flexible body", "node ids must differ from each other", "a repeated id", "number each node once"});
  for (int i = 0; i < set.node_count(); ++i)
    if (!(set.node_mass[i] > 0))
      throw InputError({"flexible body", fmt::format("the mass of node {} must be positive", set.node_ids[i]),
                        fmt::format("{:g} kg", set.node_mass[i]),
                        "leave massless nodes out, or lump the mass so that every node has its share"});
  if (!set.shapes.allFinite() || !set.node_position.allFinite() || !set.stiffness.allFinite() ||
      !set.damping.allFinite() || !set.stiffening.allFinite())
    throw InputError({"flexible body",
                      "shapes, positions, stiffness, damping and stiffening must be finite numbers",
                      "an infinity or not a number", "check how they were read"});
}

void check_mass_centre(const ShapeSet& set) {
  const double mass = set.node_mass.sum();
  const Vector3 centre = set.node_position * set.node_mass / mass;
  const double gyration_radius =
      std::sqrt(point_mass_inertia(set.node_mass, set.node_position).trace() / mass);
  if (!(centre.norm() <= ModeSet::kOrthogonalityTolerance * gyration_radius))
    throw InputError({"flexible body", "node positions must be taken about the mass centre",
                      fmt::format("mass centre at ({:g}, {:g}, {:g}) m", centre.x(), centre.y(), centre.z()),
                      "subtract the mass centre from every position"});
}

void check_orthogonality(const ShapeSet& set) {
  constexpr double tolerance = ModeSet::kOrthogonalityTolerance;
  const int m = set.shape_count();
  if (m == 0) return;
  const MatrixX M_shapes = mass_of_freedoms(set.node_mass).asDiagonal() * set.shapes;
  const double self = (set.shapes.transpose() * M_shapes - MatrixX::Identity(m, m)).cwiseAbs().maxCoeff();
  if (!(self <= tolerance))
    throw InputError(
        {"flexible body", "modes must be mass-orthonormal, Psi^T M Psi = 1",
         fmt::format("largest error {:.3g}", self),
         "divide each mode by the root of its modal mass and orthogonalise modes of equal frequency"});
  const MatrixX rigid = rigid_body_modes(set.node_mass, set.node_position);
  const double coupling = (rigid.transpose() * M_shapes).cwiseAbs().maxCoeff();
  if (set.mean_axes && !(coupling <= tolerance))
    throw InputError({"flexible body", "elastic modes must be mass-orthogonal to rigid-body motion",
                      fmt::format("largest product {:.3g}", coupling),
                      "remove the rigid-body part of each mode with the lumped masses of this set"});
}

void check_symmetry(const MatrixX& matrix, const char* name) {
  if (matrix.cols() <= 1) return;
  const double asymmetry = (matrix - matrix.transpose()).norm();
  if (!(asymmetry <= ModeSet::kOrthogonalityTolerance * matrix.norm()))
    throw InputError({"flexible body", fmt::format("the {} must be symmetric", name),
                      fmt::format("asymmetry {:.3g}", asymmetry),
                      "take its symmetric part if the difference is noise"});
}

}  // namespace

int ShapeSet::node_index(int node_id) const {
  const auto found = std::find(node_ids.begin(), node_ids.end(), node_id);
  if (found == node_ids.end())
    throw InputError({"flexible body", "there is no such node", fmt::format("node {}", node_id),
                      fmt::format("name one of the {} nodes of the flexible body", node_count())});
  return static_cast<int>(found - node_ids.begin());
}

void ShapeSet::validate() const {
  check_nodes(*this);
  check_mass_centre(*this);
  check_orthogonality(*this);
  check_symmetry(stiffness, "stiffness");
  check_symmetry(damping, "damping");
  if (stiffening.size() == 0) return;
  const Eigen::Index m = shape_count();
  for (int pair = 0; pair < 6; ++pair) check_symmetry(stiffening.middleCols(pair * m, m), "stiffening");
}

MatrixX stiffening_in(const MatrixX& stiffening, const MatrixX& T) {
  const Eigen::Index m = T.rows(), n = T.cols();
  if (stiffening.size() == 0) return {};
  MatrixX result(n, 6 * n);
  for (int pair = 0; pair < 6; ++pair)
    result.middleCols(pair * n, n) = T.transpose() * stiffening.middleCols(pair * m, m) * T;
  return result;
}

ShapeSet shapes_of(const ModeSet& modes) {
  ShapeSet set;
  set.node_ids = modes.node_ids;
  set.node_mass = modes.node_mass;
  set.node_position = modes.node_position;
  set.shapes = modes.shapes;
  set.stiffness = modes.omega.cwiseAbs2();
  set.damping = 2 * modes.damping_ratio.cwiseProduct(modes.omega);
  return set;
}

ModeSet as_modes(const ShapeSet& set) {
  const VectorX omega = set.stiffness.col(0).cwiseSqrt();
  const VectorX damping = set.damping.cols() == 1 ? VectorX(set.damping) : VectorX(set.damping.diagonal());
  return {set.node_ids, set.node_mass, set.node_position,
          omega,        set.shapes,    damping.cwiseQuotient(2 * omega)};
}

}  // namespace wishbone
