#include "identification/methods/modes.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "bodies/mode_set.h"
#include "core/error.h"

namespace wishbone {
namespace {

[[noreturn]] void refuse_mass(Eigen::Index size) {
  throw InputError({"eigenproblem", "the mass matrix must be positive definite",
                    fmt::format("{0} x {0}", size),
                    "look for massless freedoms, or for more mass taken away than there is"});
}

}  // namespace

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
  return diagonal_matrix(mass_of_freedoms(node_mass));
}

Modes solve_eigenproblem(const MatrixX& K, const MatrixX& M) {
  // Eigen's solver does not look whether its factorisation of M succeeded
  if (Eigen::LLT<MatrixX>(M).info() != Eigen::Success) refuse_mass(M.rows());
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(K, M);
  Modes modes{eigen.eigenvalues(), eigen.eigenvectors()};
  fix_signs(modes.shapes);
  return modes;
}

Modes solve_low_rank_eigenproblem(const MatrixX& B, const MatrixX& G, const SparseMatrix& M) {
  const Eigen::SimplicialLLT<SparseMatrix> mass(M);
  if (mass.info() != Eigen::Success) refuse_mass(M.rows());
  const MatrixX carried = mass.solve(B);  // M^-1 B
  // S = L L^T makes G S y = lambda y symmetric: (L^T G L) w = lambda w, y = L^-T w
  const Eigen::LLT<MatrixX> S(B.transpose() * carried);
  if (S.info() != Eigen::Success)
    throw InputError({"eigenproblem", "the modes must be linearly independent",
                      fmt::format("{} modes", B.cols()), "leave out modes that were measured twice"});
  const MatrixX L = S.matrixL();
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(L.transpose() * G * L);
  Modes modes{eigen.eigenvalues(), carried * S.matrixU().solve(eigen.eigenvectors())};
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
