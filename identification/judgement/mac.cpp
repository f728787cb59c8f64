#include "identification/judgement/mac.h"

namespace wishbone {

MatrixX modal_assurance(const MatrixX& A, const MatrixX& B) {
  const auto inverse_norms = [](const MatrixX& X) -> VectorX {
    return X.colwise().norm().unaryExpr([](double n) { return n > 0 ? 1 / n : 0.0; }).transpose();
  };
  const MatrixX cosines = inverse_norms(A).asDiagonal() * (A.transpose() * B) * inverse_norms(B).asDiagonal();
  return cosines.cwiseAbs2();
}

}  // namespace wishbone
