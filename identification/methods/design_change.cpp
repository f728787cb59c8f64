#include "identification/methods/design_change.h"

namespace wishbone {
namespace {

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
  return solve_low_rank_eigenproblem(M * unit.shapes, changed_modal_stiffness(unit, dK), M + dM);
}

Modes change_structure(Space space, const Modes& modes, const SparseMatrix& M, const SparseMatrix& dM,
                       const SparseMatrix& dK) {
  return space == Space::kModal ? change_in_modal_space(modes, M, dM, dK)
                                : change_in_physical_space(modes, M, dM, dK);
}

}  // namespace wishbone
