#include "identification/methods/residual.h"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>

namespace wishbone {

VectorX relative_residuals(const Modes& modes, const MatrixX& K_shapes, const SparseMatrix& M,
                           const SparseMatrix& D) {
  const Eigen::SimplicialLDLT<SparseMatrix> mass(M);
  MatrixX r = K_shapes - M * modes.shapes * modes.lambda.asDiagonal();
  if (D.rows() > 0) {
    // min over mu of |r - D^T mu| in the metric of M^-1: (D M^-1 D^T) mu = D M^-1 r
    const SparseMatrix D_T = D.transpose();
    const MatrixX carried = mass.solve(MatrixX(D_T));
    const MatrixX gram = D * carried;
    r -= D_T * gram.completeOrthogonalDecomposition().solve(carried.transpose() * r);
  }
  const MatrixX carried = mass.solve(r);
  return r.cwiseProduct(carried).colwise().sum().transpose().cwiseMax(0).cwiseSqrt().cwiseQuotient(
      modes.lambda);
}

}  // namespace wishbone
