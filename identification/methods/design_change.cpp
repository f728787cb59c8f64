#include "identification/methods/design_change.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "core/error.h"

namespace wishbone {
namespace {

[[noreturn]] void refuse_mass(Eigen::Index freedoms) {
  throw InputError({"design change", "the mass after the change must be positive",
                    fmt::format("a singular or indefinite mass matrix of {} freedoms", freedoms),
                    "take away no more mass than there is at every freedom"});
}

/// Lambda + Psi^T dK Psi of modes of unit modal mass.
MatrixX changed_modal_stiffness(const Modes& unit, const SparseMatrix& dK) {
  MatrixX K = unit.shapes.transpose() * (dK * unit.shapes);
  K.diagonal() += unit.lambda;
  return (K + K.transpose()) / 2;
}

}  // namespace

Modes change_in_modal_space(const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                            const SparseMatrix& dK) {
  const Modes unit = mass_normalised(modes, M);
  // psi_new = Psi psi_II [2.33]
  Modes changed = solve_eigenproblem(changed_modal_stiffness(unit, dK),
                                     unit.shapes.transpose() * ((M + dM) * unit.shapes));
  changed.shapes = unit.shapes * changed.shapes;
  fix_signs(changed.shapes);
  return changed;
}

Modes change_in_physical_space(const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                               const SparseMatrix& dK) {
  const Modes unit = mass_normalised(modes, M);
  const MatrixX B = M * unit.shapes;
  const Eigen::SimplicialLLT<SparseMatrix> M_changed(M + dM);
  if (M_changed.info() != Eigen::Success) refuse_mass(M.rows());
  const MatrixX carried = M_changed.solve(B);  // (M + dM)^-1 B

  // G S y = lambda y with S = L L^T: the symmetric problem L^T G L w = lambda w, y = L^-T w
  const Eigen::LLT<MatrixX> S(B.transpose() * carried);
  if (S.info() != Eigen::Success) refuse_mass(M.rows());
  const MatrixX L = S.matrixL();
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(L.transpose() * changed_modal_stiffness(unit, dK) * L);
  Modes changed{eigen.eigenvalues(), carried * S.matrixU().solve(eigen.eigenvectors())};
  fix_signs(changed.shapes);
  return changed;
}

Modes change_structure(Space space, const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                       const SparseMatrix& dK) {
  return space == Space::kModal ? change_in_modal_space(modes, M, dM, dK)
                                : change_in_physical_space(modes, M, dM, dK);
}

}  // namespace wishbone
