#include "identification/methods/clean_up.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "core/error.h"

namespace wishbone {

Modes cleaned_up(const Modes& modes, const SparseMatrix& M, const MatrixX& rigid) {
  Modes elastic = mass_normalised(modes, M);
  elastic.shapes -= rigid * (rigid.transpose() * (M * elastic.shapes));
  const VectorX left = modal_masses(elastic.shapes, M);
  for (Eigen::Index j = 0; j < left.size(); ++j)
    if (!(left[j] > 1e-12))
      throw InputError({"modes", fmt::format("mode {} is nothing but rigid-body motion", j + 1),
                        fmt::format("elastic share {:.2g} of its modal mass", left[j]), "leave it out"});
  elastic = mass_normalised(elastic, M);
  const Eigen::SelfAdjointEigenSolver<MatrixX> gram(elastic.shapes.transpose() * (M * elastic.shapes));
  if (!(gram.eigenvalues()[0] > 1e-10 * gram.eigenvalues()[gram.eigenvalues().size() - 1]))
    throw InputError({"modes", "the modes must be linearly independent",
                      fmt::format("smallest eigenvalue {:.2g} of Psi^T M Psi", gram.eigenvalues()[0]),
                      "leave out modes that were measured twice"});
  elastic.shapes *= gram.operatorInverseSqrt();
  return elastic;
}

double orthogonality_error(const MatrixX& shapes, const SparseMatrix& M) {
  const VectorX scale = modal_masses(shapes, M).cwiseSqrt().cwiseInverse();
  MatrixX gram = scale.asDiagonal() * (shapes.transpose() * (M * shapes)) * scale.asDiagonal();
  gram.diagonal().setZero();
  return gram.size() == 0 ? 0 : gram.cwiseAbs().maxCoeff();
}

}  // namespace wishbone
