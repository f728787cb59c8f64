#include "identification/free_free_modes.h"

#include <fmt/format.h>

#include "core/error.h"
#include "identification/methods/modes.h"

namespace wishbone {
namespace {

void check_input(const std::vector<int>& node_ids, const VectorX& node_mass, const Matrix3X& node_position,
                 const MatrixX& stiffness) {
  const Eigen::Index n = static_cast<Eigen::Index>(node_ids.size());
  if (node_mass.size() != n || node_position.cols() != n || stiffness.rows() != 3 * n ||
      stiffness.cols() != 3 * n)
    throw InputError({"free-free modes",
                      fmt::format("{} nodes need as many masses and positions and a {} x {} stiffness matrix",
                                  n, 3 * n, 3 * n),
                      fmt::format("{} masses, {} positions, {} x {} stiffness", node_mass.size(),
                                  node_position.cols(), stiffness.rows(), stiffness.cols()),
                      "give three displacements to every node"});
  if (n < 3)
    throw InputError({"free-free modes", "a flexible body needs at least three nodes", fmt::format("{}", n),
                      "give more nodes"});
  if (!(node_mass.minCoeff() > 0))
    throw InputError({"free-free modes", "every node must have a positive mass",
                      fmt::format("{:g} kg", node_mass.minCoeff()),
                      "condense massless nodes out of the stiffness first"});
  const double asymmetry = (stiffness - stiffness.transpose()).norm();
  if (!(asymmetry <= 1e-8 * stiffness.norm()))
    throw InputError({"free-free modes", "the stiffness matrix must be symmetric",
                      fmt::format("asymmetry {:.3g}", asymmetry / stiffness.norm()),
                      "take its symmetric part if the difference is noise"});
}

}  // namespace

ModeSet free_free_modes(const std::vector<int>& node_ids, const VectorX& node_mass,
                        const Matrix3X& node_position, const MatrixX& stiffness) {
  check_input(node_ids, node_mass, node_position, stiffness);
  const Vector3 centre = node_position * node_mass / node_mass.sum();
  const Matrix3X s = node_position.colwise() - centre;
  const VectorX root_mass = mass_of_freedoms(node_mass).cwiseSqrt();
  const VectorX inverse_root_mass = root_mass.cwiseInverse();

  // K_hat = M^-1/2 K M^-1/2 in mass-weighted coordinates, where rigid motion is Y = M^1/2 Psi_0, Y^T Y = 1
  const MatrixX K_hat = inverse_root_mass.asDiagonal() * stiffness * inverse_root_mass.asDiagonal();
  const MatrixX Y = root_mass.asDiagonal() * rigid_body_modes(node_mass, s);
  const double resistance = (K_hat * Y).norm() / K_hat.norm();
  if (!(resistance <= 1e-6))
    throw InputError({"free-free modes", "the stiffness must not resist rigid-body motion of a free body",
                      fmt::format("relative resistance {:.3g}", resistance),
                      "remove supports and springs to ground from it"});

  const MatrixX Q = elastic_complement(node_mass, s);
  const Eigen::Index elastic_count = Q.cols();
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(Q.transpose() * K_hat * Q);
  const VectorX& lambda = eigen.eigenvalues();
  if (!(lambda[0] > 1e-12 * lambda[elastic_count - 1]))
    throw InputError(
        {"free-free modes", "the stiffness must resist every motion that is not rigid",
         fmt::format("smallest eigenvalue {:.3g} of a largest {:.3g} rad2/s2", lambda[0],
                     lambda[elastic_count - 1]),
         "look for loose parts, hinges between elements or a stiffness identified from too few modes"});

  ModeSet set{node_ids, node_mass, s, lambda.cwiseSqrt(), MatrixX(), VectorX::Zero(elastic_count)};
  set.shapes = inverse_root_mass.asDiagonal() * (Q * eigen.eigenvectors());
  fix_signs(set.shapes);
  return set;
}

ModeSet free_free_modes(const Mesh& mesh, const IsotropicMaterial& material) {
  return free_free_modes(mesh.node_ids, lumped_mass(mesh, material.density), mesh.nodes,
                         MatrixX(stiffness_matrix(mesh, material)));
}

}  // namespace wishbone
