#include "identification/methods/spring_support.h"

namespace wishbone {

Modes hold_by_springs(Space space, const Modes& free, const SparseMatrix& M, const SparseMatrix& K_s) {
  return change_structure(space, free, M, SparseMatrix(M.rows(), M.cols()), K_s);
}

Modes release_from_springs(Space space, const Modes& supported, const SparseMatrix& M_t,
                           const SparseMatrix& M_s, const SparseMatrix& K_s) {
  return change_structure(space, supported, M_t, -M_s, -K_s);
}

}  // namespace wishbone
