#include "identification/methods/mass_distribution.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "core/error.h"
#include "identification/methods/nnls.h"

namespace wishbone {
namespace {

void check(const RigidBodyData& body, const Matrix3X& node_position, const MatrixX& shapes) {
  const auto refuse = [](std::string what, std::string value, std::string remedy) {
    throw InputError({"mass distribution", std::move(what), std::move(value), std::move(remedy)});
  };
  if (shapes.rows() != node_position.size())
    refuse("every node needs three freedoms",
           fmt::format("{} rows for {} nodes", shapes.rows(), node_position.cols()),
           "expand the measurement to all directions first");
  if (!(body.mass > 0))
    refuse("the mass must be positive", fmt::format("{:g} kg", body.mass), "weigh the body");
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(body.inertia, Eigen::EigenvaluesOnly);
  if (!(principal.eigenvalues()[0] > 0))
    refuse("the inertia must be positive definite",
           fmt::format("smallest principal inertia {:g} kg m2", principal.eigenvalues()[0]),
           "check the signs of the products of inertia");
}

/// Rows of the equations for the mass, the first moments and the inertia (10 x n), and their right side.
void rigid_body_rows(const RigidBodyData& body, const Matrix3X& node_position, MatrixX& A, VectorX& b) {
  const Matrix3X s = node_position.colwise() - body.centre;
  A.row(0).setOnes();
  b[0] = body.mass;
  A.middleRows(1, 3) = s;
  b.segment(1, 3).setZero();
  const int row_of[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = row_of[k];
    A.row(4 + k) = -s.row(i).cwiseProduct(s.row(j));
    if (i == j) A.row(4 + k) += s.colwise().squaredNorm();
    b[4 + k] = body.inertia(i, j);
  }
}

/// Rows of the orthogonality of modes i < j and their right side.
void orthogonality_rows(const MatrixX& shapes, const SparseMatrix& M_s, MatrixX& A, VectorX& b) {
  const Eigen::Index n = A.cols();
  const MatrixX support = shapes.transpose() * (M_s * shapes);
  Eigen::Index row = 10;
  for (Eigen::Index j = 1; j < shapes.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i, ++row) {
      const VectorX product = shapes.col(i).cwiseProduct(shapes.col(j));
      A.row(row) = product.reshaped(3, n).colwise().sum();
      b[row] = -support(i, j);
    }
}

}  // namespace

MassDistribution distribute_mass(const RigidBodyData& body, const Matrix3X& node_position,
                                 const MatrixX& shapes, const SparseMatrix& M_s) {
  check(body, node_position, shapes);
  const Eigen::Index n = node_position.cols(), m = shapes.cols(), equations = 10 + m * (m - 1) / 2;
  MatrixX A(equations, n);
  VectorX b(equations);
  rigid_body_rows(body, node_position, A, b);
  orthogonality_rows(shapes.colwise().normalized(), M_s, A, b);
  // Rigid-body rows to unit length each; orthogonality rows by one factor, for a row that symmetry makes vanish
  // would be blown up to noise.
  const auto scale = [&](Eigen::Index first, Eigen::Index count, double norm) {
    if (!(norm > 0)) return;
    A.middleRows(first, count) /= norm;
    b.segment(first, count) /= norm;
  };
  for (Eigen::Index i = 0; i < 10; ++i) scale(i, 1, A.row(i).norm());
  if (equations > 10) scale(10, equations - 10, A.bottomRows(equations - 10).rowwise().norm().maxCoeff());

  MassDistribution distribution;
  distribution.equations = static_cast<int>(equations);
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  qr.setThreshold(1e-9);
  distribution.rank = static_cast<int>(qr.compute(A).rank());
  // a last block of rows, epsilon x = 0, picks the solution of least norm
  constexpr double kEpsilon = 1e-8;
  MatrixX regularised(equations + n, n);
  regularised << A, kEpsilon * MatrixX::Identity(n, n);
  VectorX right = VectorX::Zero(equations + n);
  right.head(equations) = b;
  distribution.node_mass = nonnegative_least_squares(regularised, right);
  distribution.residual = (A * distribution.node_mass - b).norm() / b.norm();
  return distribution;
}

}  // namespace wishbone
