#include "identification/methods/stiffness_from_modes.h"

namespace wishbone {

MatrixX stiffness_from_modes(const Modes& modes, const SparseMatrix& M) {
  const Modes unit = mass_normalised(modes, M);
  const MatrixX M_shapes = M * unit.shapes;
  return M_shapes * unit.lambda.asDiagonal() * M_shapes.transpose();
}

}  // namespace wishbone
