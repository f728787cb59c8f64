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
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(K, M);
  if (eigen.info() != Eigen::Success)
    throw InputError({"eigenproblem", "the mass matrix must be positive definite",
                      fmt::format("{} freedoms", M.rows()),
                      "look for massless freedoms, or for modes that are linearly dependent"});
  Modes modes{eigen.eigenvalues(), eigen.eigenvectors()};
  fix_signs(modes.shapes);
  return modes;
}

void fix_signs(MatrixX& shapes) {
  for (auto shape : shapes.colwise()) {
    const double nearly_largest = (1 - 1e-6) * shape.cwiseAbs().maxCoeff();
    for (const double component : shape) {
      if (std::abs(component) < nearly_largest) continue;
      if (component < 0) shape = -shape;
      break;
    }
  }
}

}  // namespace wishbone
