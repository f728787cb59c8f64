#include "identification/methods/rigid_modes.h"

#include <Eigen/Eigenvalues>

namespace wishbone {

MatrixX rigid_body_basis(const MatrixX& shapes, const SparseMatrix& M) {
  // each motion scaled to unit modal mass first, so that metres and radians compare
  const MatrixX M_shapes = M * shapes;
  MatrixX gram = shapes.transpose() * M_shapes;
  const VectorX scale = gram.diagonal().unaryExpr([](double g) { return g > 0 ? 1 / std::sqrt(g) : 0.0; });
  gram = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(gram);
  constexpr double kNoMass = 1e-12;  // of the largest eigenvalue, which is at least 1
  const Eigen::Index first =
      (eigen.eigenvalues().array() <= kNoMass * eigen.eigenvalues().maxCoeff()).count();
  const Eigen::Index count = shapes.cols() - first;

  MatrixX basis = shapes * (scale.asDiagonal() * eigen.eigenvectors().rightCols(count));
  // once more from the basis itself: orthonormal to rounding whatever the conditioning was
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::LLT<MatrixX> L(basis.transpose() * (M * basis));
    basis = L.matrixL().solve(basis.transpose()).transpose();
  }
  return basis;
}

Modes with_rigid_body_modes(const MatrixX& rigid, const Modes& elastic) {
  Modes all{VectorX::Zero(rigid.cols() + elastic.count()),
            MatrixX(rigid.rows(), rigid.cols() + elastic.count())};
  all.lambda.tail(elastic.count()) = elastic.lambda;
  all.shapes << rigid, elastic.shapes;
  return all;
}

VectorX rigid_share(const MatrixX& rigid, const MatrixX& shapes, const SparseMatrix& M) {
  const MatrixX P = rigid.transpose() * (M * shapes);
  return P.colwise().squaredNorm().transpose().cwiseQuotient(modal_masses(shapes, M));
}

}  // namespace wishbone
