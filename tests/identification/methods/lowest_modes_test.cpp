#include "identification/methods/lowest_modes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "bodies/mode_set.h"
#include "core/error.h"
#include "identification/elements/mesh.h"
#include "identification/free_free_modes.h"

namespace wishbone {
namespace {

constexpr IsotropicMaterial kSteel{2.1e11, 0.3, 7850};

struct Structure {
  Mesh mesh;
  SparseMatrix K, M;
};

Structure block(const Vector3& size, const Eigen::Vector3i& divisions) {
  Structure s{make_block(size, divisions), {}, {}};
  s.K = stiffness_matrix(s.mesh, kSteel);
  s.M = lumped_mass_matrix(lumped_mass(s.mesh, kSteel.density));
  return s;
}
/// 630 freedoms, no two frequencies alike.
Structure free_block() {
  return block({1, 0.12, 0.2}, {13, 2, 4});
}
/// The same on springs at both ends.
Structure supported_block() {
  Structure s = free_block();
  for (const int row : {0, 1, 2, 44, 627, 629}) s.K.coeffRef(row, row) += 1e8;
  return s;
}

double orthonormality_error(const Modes& modes, const SparseMatrix& M) {
  const MatrixX gram = modes.shapes.transpose() * (M * modes.shapes);
  return (gram - MatrixX::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

double largest_relative_difference(const VectorX& a, const VectorX& b) {
  return (a.cwiseQuotient(b).array() - 1).abs().maxCoeff();
}

TEST(LowestModes, AreTheFirstOfTheDenseSolutionOfASupportedStructure) {
  const Structure s = supported_block();
  const Modes modes = lowest_modes(s.K, s.M, 20);
  const Modes dense = solve_eigenproblem(MatrixX(s.K), MatrixX(s.M));
  // rounding in the dense solution is relative to its largest eigenvalue
  EXPECT_LE((modes.lambda - dense.lambda.head(20)).cwiseAbs().maxCoeff(), 1e-14 * dense.lambda.maxCoeff());
  EXPECT_LE((modes.shapes - dense.shapes.leftCols(20)).cwiseAbs().maxCoeff(),
            1e-7 * dense.shapes.cwiseAbs().maxCoeff());
  EXPECT_LE(orthonormality_error(modes, s.M), 1e-12);
}

TEST(LowestModes, OfAFreeBodyAreSixRigidOnesAndItsElasticOnes) {
  const Structure s = free_block();
  const Modes modes = lowest_modes(s.K, s.M, 26);
  const ModeSet elastic = free_free_modes(s.mesh, kSteel);
  EXPECT_LE(modes.lambda.head(6).cwiseAbs().maxCoeff(), 1e-9 * modes.lambda[6]);
  EXPECT_LE(largest_relative_difference(modes.lambda.tail(20), elastic.omega.head(20).cwiseAbs2()), 1e-10);
  EXPECT_LE((modes.shapes.rightCols(20) - elastic.shapes.leftCols(20)).cwiseAbs().maxCoeff(),
            1e-7 * elastic.shapes.cwiseAbs().maxCoeff());
  EXPECT_LE(orthonormality_error(modes, s.M), 1e-12);
}

TEST(LowestModes, SolveTheEigenproblemOfAConsistentMassMatrix) {
  // Rod of linear elements, free at both ends, k = m = 1: K = tridiag(-1, 2, -1), M = tridiag(1, 4, 1) / 6
  // with halves at the ends. lambda_j = 6 (1 - cos a) / (2 + cos a), a = j pi / N.
  const int N = 400, count = 25;
  SparseMatrix K(N + 1, N + 1), M(N + 1, N + 1);
  for (int e = 0; e < N; ++e)
    for (const int i : {0, 1})
      for (const int j : {0, 1}) {
        K.coeffRef(e + i, e + j) += i == j ? 1 : -1;
        M.coeffRef(e + i, e + j) += i == j ? 1.0 / 3 : 1.0 / 6;
      }
  const Modes modes = lowest_modes(K, M, count);
  EXPECT_LE(std::abs(modes.lambda[0]), 1e-14);
  for (int j = 1; j < count; ++j) {
    const double cosine = std::cos(j * std::numbers::pi / N);
    EXPECT_NEAR(modes.lambda[j], 6 * (1 - cosine) / (2 + cosine), 1e-14);
  }
  EXPECT_LE(orthonormality_error(modes, M), 1e-12);
}

TEST(LowestModes, OfACubeHaveTheirFullMultiplicity) {
  // The symmetry of the cube repeats frequencies two and three times.
  const Structure s = block({1, 1, 1}, {6, 6, 6});
  const Modes modes = lowest_modes(s.K, s.M, 37);
  const VectorX elastic = free_free_modes(s.mesh, kSteel).omega.cwiseAbs2();
  EXPECT_LE(elastic[4] / elastic[2] - 1, 1e-9);  // the case is what it claims to be
  EXPECT_LE(largest_relative_difference(modes.lambda.tail(31), elastic.head(31)), 1e-10);
  EXPECT_LE(orthonormality_error(modes, s.M), 1e-12);
}

TEST(LowestModes, AreFoundHoweverOftenTheyAreRepeated) {
  // Ten loose beams: sixty rigid-body modes, then each elastic eigenvalue ten times, twenty times in bending.
  const Structure one = block({1, 0.1, 0.1}, {5, 1, 1});
  const Eigen::Index n = one.K.rows(), copies = 10;
  SparseMatrix K(copies * n, copies * n), M(copies * n, copies * n);
  for (Eigen::Index c = 0; c < copies; ++c)
    for (Eigen::Index j = 0; j < n; ++j) {
      M.insert(c * n + j, c * n + j) = one.M.coeff(j, j);
      for (SparseMatrix::InnerIterator entry(one.K, j); entry; ++entry)
        K.insert(c * n + entry.row(), c * n + j) = entry.value();
    }
  const Modes modes = lowest_modes(K, M, 85);
  const double bending = std::pow(free_free_modes(one.mesh, kSteel).omega[0], 2);
  EXPECT_LE(modes.lambda.head(60).cwiseAbs().maxCoeff(), 1e-9 * bending);
  EXPECT_LE((modes.lambda.segment(60, 20).array() / bending - 1).abs().maxCoeff(), 1e-9);
  EXPECT_GE(modes.lambda[80], 1.01 * bending);
}

TEST(LowestModes, DoNotDependOnTheShift) {
  const Structure s = free_block();
  const Modes modes = lowest_modes(s.K, s.M, 20);
  for (const double factor : {0.1, 1.0, 10.0}) {
    const Modes shifted = lowest_modes(s.K, s.M, 20, -factor * modes.lambda[6]);
    EXPECT_LE(largest_relative_difference(shifted.lambda.tail(14), modes.lambda.tail(14)), 1e-10);
    EXPECT_LE((shifted.shapes.rightCols(14) - modes.shapes.rightCols(14)).cwiseAbs().maxCoeff(),
              1e-7 * modes.shapes.cwiseAbs().maxCoeff());
  }
}

TEST(LowestModes, AreTheSameBitsEveryTime) {
  const Structure s = free_block();
  const Modes a = lowest_modes(s.K, s.M, 20), b = lowest_modes(s.K, s.M, 20);
  EXPECT_EQ(a.lambda, b.lambda);
  EXPECT_EQ(a.shapes, b.shapes);
}

TEST(LowestModes, OfSixThousandFreedomsAreOrthonormalAndSolveTheEigenproblem) {
  const Structure s = block({1, 0.1, 0.1}, {55, 5, 5});
  const Modes modes = lowest_modes(s.K, s.M, 40);
  EXPECT_LE(orthonormality_error(modes, s.M), 1e-12);
  EXPECT_LE(modes.lambda.head(6).cwiseAbs().maxCoeff(), 1e-9 * modes.lambda[6]);
  // Krylov-Weinstein: an eigenvalue lies within |r|, in the metric of M^-1, of lambda
  const MatrixX r = s.K * modes.shapes - s.M * modes.shapes * modes.lambda.asDiagonal();
  const VectorX mass = s.M.diagonal();
  const VectorX bound = (mass.cwiseSqrt().cwiseInverse().asDiagonal() * r).colwise().norm();
  EXPECT_LE(bound.tail(34).cwiseQuotient(modes.lambda.tail(34)).maxCoeff(), 1e-6);
}

TEST(LowestModes, RejectWhatIsNoEigenproblem) {
  const Structure s = free_block();
  const auto rejects = [&](const SparseMatrix& K, const SparseMatrix& M, int count,
                           std::optional<double> shift = std::nullopt) {
    EXPECT_THROW(lowest_modes(K, M, count, shift), InputError);
  };
  rejects(s.K, s.M, 0);
  rejects(s.K, s.M, 631);
  rejects(s.K, lumped_mass_matrix(VectorX::Ones(3)), 10);
  rejects(s.K.triangularView<Eigen::Lower>(), s.M, 10);
  SparseMatrix massless = s.M;
  massless.coeffRef(7, 7) = 0;
  rejects(s.K, massless, 10);
  SparseMatrix broken = s.K;
  broken.coeffRef(7, 7) = std::numeric_limits<double>::quiet_NaN();
  rejects(broken, s.M, 10);
  rejects(s.K, s.M, 10, 1e9);  // above the lowest eigenvalue
  rejects(-s.K, s.M, 10);
}

}  // namespace
}  // namespace wishbone
