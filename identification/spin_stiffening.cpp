#include "identification/spin_stiffening.h"

#include <fmt/format.h>

#include "core/axis_pairs.h"
#include "core/error.h"
#include "identification/methods/held_stiffness.h"

namespace wishbone {
namespace {

using Displacements = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// w x (w x r) = (w w^T - w^T w 1) r = sum_{a <= b} w_a w_b E_ab r
Matrix3 spin_matrix(AxisPair pair) {
  Matrix3 E = pair.a == pair.b ? Matrix3(-Matrix3::Identity()) : Matrix3(Matrix3::Zero());
  E(pair.a, pair.b) += 1;
  if (pair.a != pair.b) E(pair.b, pair.a) += 1;
  return E;
}

/// -m_i E_ab (s_i - s_C)
Displacements spin_loads(const ModeSet& set, const Vector3& centre) {
  Displacements F(3 * set.node_count(), 6);
  for (int k = 0; k < 6; ++k) {
    const Matrix3 E = spin_matrix(kAxisPairs[k]);
    for (int i = 0; i < set.node_count(); ++i)
      F.col(k).segment<3>(3 * i) = -set.node_mass[i] * E * (set.node_position.col(i) - centre);
  }
  return F;
}

void check_hold(const ModeSet& set, const std::vector<int>& held) {
  const Eigen::Index free = free_rigid_motions(rigid_body_modes(set.node_mass, set.node_position), held);
  if (free == 0) return;
  throw InputError({"geometric stiffening", "the held nodes must hold the body",
                    fmt::format("{} of 6 rigid motions left free", free),
                    "name at least three nodes that do not lie on one line, or spin it 'free'"});
}

/// x_ab
Displacements spin_deflections(const SparseMatrix& K, const ModeSet& set, const SpinLoad& load) {
  if (load.held.empty()) {
    Displacements F = spin_loads(set, load.centre.value_or(Vector3::Zero()));
    const MatrixX rigid = rigid_body_modes(set.node_mass, set.node_position);
    const MatrixX M_rigid = mass_of_freedoms(set.node_mass).asDiagonal() * rigid;
    F -= M_rigid * (rigid.transpose() * F);
    const HeldStiffness support(K, determinate_support(rigid));
    Displacements x = support.solve(F);
    x += support.solve(F - K * x);  // one refinement: the support may be far softer than the elements
    return x;
  }
  std::vector<bool> held(static_cast<std::size_t>(K.rows()), false);
  std::vector<int> freedoms;
  Vector3 centre = Vector3::Zero();
  for (const int id : load.held) {
    const int node = set.node_index(id);
    for (int axis = 0; axis < 3; ++axis) {
      freedoms.push_back(3 * node + axis);
      held[static_cast<std::size_t>(freedoms.back())] = true;
    }
    centre += set.node_position.col(node) / static_cast<double>(load.held.size());
  }
  check_hold(set, freedoms);
  return HeldStiffness(K, held).solve(spin_loads(set, load.centre.value_or(centre)));
}

}  // namespace

MatrixX spin_stiffening(const Mesh& mesh, const IsotropicMaterial& material, const ModeSet& set,
                        const SpinLoad& load) {
  const Displacements x = spin_deflections(stiffness_matrix(mesh, material), set, load);
  const Matrix6 elasticity = material.elasticity();
  const Eigen::Index m = set.mode_count(), n = mesh.elements.rows();
  MatrixX stiffening = MatrixX::Zero(m, 6 * m);
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const SolidElement element = mesh.element(e, elasticity);
    const std::vector<int> freedoms = mesh.freedoms(e);
    const MatrixX shapes = set.shapes(freedoms, Eigen::all);
    const Displacements u = x(freedoms, Eigen::all);
    for (int pair = 0; pair < 6; ++pair) {
      const MatrixX K = element.stress_stiffness(u.col(pair));
      // K_ab += sum over the axes of Psi_axis^T K Psi_axis, rows of an axis every third
      for (int axis = 0; axis < 3; ++axis) {
        const MatrixX along = shapes(Eigen::seqN(axis, n, 3), Eigen::all);
        stiffening.middleCols(pair * m, m).noalias() += along.transpose() * (K * along);
      }
    }
  }
  return stiffening;
}

}  // namespace wishbone
