#include "identification/methods/support_matrices.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Rows of x, y, z of every node; -1 where a freedom is not listed.
class Rows {
 public:
  explicit Rows(const std::vector<Freedom>& freedoms) {
    for (std::size_t i = 0; i < freedoms.size(); ++i)
      rows_.try_emplace(freedoms[i].node, std::array{-1, -1, -1})
          .first->second[static_cast<std::size_t>(freedoms[i].axis)] = static_cast<int>(i);
  }

  /// The non-zero components of u as (row, component).
  std::vector<std::pair<int, double>> of(int node, const Vector3& u) const {
    std::vector<std::pair<int, double>> components;
    const auto found = rows_.find(node);
    for (int axis = 0; axis < 3; ++axis) {
      if (u[axis] == 0) continue;
      const int row = found == rows_.end() ? -1 : found->second[static_cast<std::size_t>(axis)];
      if (row < 0)
        throw InputError({"support", "it acts on a freedom that the modes do not show",
                          to_string(Freedom{node, axis}),
                          "measure this freedom, or expand the modes to a model that has it"});
      components.emplace_back(row, u[axis]);
    }
    return components;
  }

  /// All listed freedoms of a node that has a mass.
  std::vector<int> of(int node) const {
    const auto found = rows_.find(node);
    if (found == rows_.end())
      throw InputError({"support", "a mass stands on a node that the modes do not show",
                        fmt::format("node {}", node),
                        "measure this node, or expand the modes to a model that has it"});
    std::vector<int> listed;
    for (const int row : found->second)
      if (row >= 0) listed.push_back(row);
    return listed;
  }

 private:
  std::map<int, std::array<int, 3>> rows_;
};

SparseMatrix assembled(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  SparseMatrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

SupportMatrices support_matrices(const Support& support, const std::vector<Freedom>& freedoms) {
  const Rows rows(freedoms);
  Triplets springs, masses, joints;
  for (const Support::Spring& spring : support.springs) {
    const auto u = rows.of(spring.node, spring.direction);
    for (const auto& [i, u_i] : u)
      for (const auto& [j, u_j] : u) springs.emplace_back(i, j, spring.stiffness * u_i * u_j);
  }
  for (const Support::Mass& mass : support.masses)
    for (const int i : rows.of(mass.node)) masses.emplace_back(i, i, mass.mass);
  for (std::size_t c = 0; c < support.joints.size(); ++c)
    for (const auto& [i, u_i] : rows.of(support.joints[c].node, support.joints[c].direction))
      joints.emplace_back(static_cast<int>(c), i, u_i);

  const auto n = static_cast<Eigen::Index>(freedoms.size());
  return {assembled(n, n, springs), assembled(n, n, masses),
          assembled(static_cast<Eigen::Index>(support.joints.size()), n, joints)};
}

}  // namespace wishbone
