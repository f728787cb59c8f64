#include "identification/methods/modes.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace wishbone {

VectorX Modes::frequency_hz() const {
  return lambda.cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
}

VectorX modal_masses(const MatrixX& shapes, const SparseMatrix& M) {
  const MatrixX M_shapes = M * shapes;
  return shapes.cwiseProduct(M_shapes).colwise().sum().transpose();
}

Modes mass_normalised(const Modes& modes, const SparseMatrix& M) {
  const VectorX m = modal_masses(modes.shapes, M);
  for (Eigen::Index j = 0; j < m.size(); ++j)
    if (!(m[j] > 0))
      throw InputError({"modes", fmt::format("the modal mass psi^T M psi of mode {} must be positive", j + 1),
                        fmt::format("{:g}", m[j]), "check the mass matrix and that the shape is not zero"});
  return {modes.lambda, modes.shapes * m.cwiseSqrt().cwiseInverse().asDiagonal()};
}

SparseMatrix diagonal_matrix(const VectorX& d) {
  SparseMatrix D(d.size(), d.size());
  D.reserve(Eigen::VectorXi::Ones(d.size()));
  for (Eigen::Index i = 0; i < d.size(); ++i) D.insert(i, i) = d[i];
  D.makeCompressed();
  return D;
}

SparseMatrix lumped_mass_matrix(const VectorX& node_mass) {
  return diagonal_matrix(node_mass.transpose().replicate(3, 1).reshaped());
}

Modes solve_eigenproblem(const MatrixX& K, const MatrixX& M) {
  // Eigen's solver does not look whether its factorisation of M succeeded
  if (Eigen::LLT<MatrixX>(M).info() != Eigen::Success)
    throw InputError({"eigenproblem", "the mass matrix must be positive definite",
                      fmt::format("{} x {}", M.rows(), M.cols()),
                      "look for massless freedoms, or for more mass taken away than there is"});
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(K, M);
  Modes modes{eigen.eigenvalues(), eigen.eigenvectors()};
  fix_signs(modes.shapes);
  return modes;
}

VectorX dominant_signs(const MatrixX& shapes) {
  VectorX signs = VectorX::Ones(shapes.cols());
  for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
    const double nearly_largest = (1 - 1e-6) * shapes.col(j).cwiseAbs().maxCoeff();
    for (const double component : shapes.col(j)) {
      if (std::abs(component) < nearly_largest) continue;
      if (component < 0) signs[j] = -1;
      break;
    }
  }
  return signs;
}

void fix_signs(MatrixX& shapes) {
  shapes *= dominant_signs(shapes).asDiagonal();
}

}  // namespace wishbone
