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

VectorX frequency_error_estimate(const VectorX& lambda, const VectorX& residual, double lambda_kept) {
  VectorX estimate(lambda.size());
  for (Eigen::Index j = 0; j < lambda.size(); ++j) {
    const double rho = residual[j], gap = lambda_kept - lambda[j];
    const bool is_below = rho * lambda[j] < gap;  // else the second order says no more than the first
    estimate[j] = (is_below ? rho * rho * lambda[j] / gap : rho) / 2;
  }
  return estimate;
}

}  // namespace wishbone
