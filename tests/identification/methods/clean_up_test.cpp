#include "identification/methods/clean_up.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

MatrixX noise(Eigen::Index rows, Eigen::Index columns, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, size);
  MatrixX A(rows, columns);
  for (double& a : A.reshaped()) a = normal(random);
  return A;
}

TEST(CleanUp, LeavesExactModesAsTheyAre) {
  const TestStructure s = chassis();
  const Modes exact = s.elastic().lowest(20);
  Modes scaled = exact;
  for (Eigen::Index j = 0; j < 20; ++j) scaled.shapes.col(j) *= 1.0 + 3.0 * static_cast<double>(j);
  const Modes clean = cleaned_up(scaled, s.M, s.rigid);
  EXPECT_LE((clean.shapes - exact.shapes).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(clean.lambda, exact.lambda);
}

TEST(CleanUp, MakesNoisyModesOrthonormalAndFreeOfRigidMotion) {
  const TestStructure s = l_shape();
  Modes noisy = s.elastic().lowest(15);
  noisy.shapes += noise(s.n(), 15, 1e-3, 1);
  EXPECT_GE(orthogonality_error(noisy.shapes, s.M), 1e-3);
  const Modes clean = cleaned_up(noisy, s.M, s.rigid);
  EXPECT_LE(orthogonality_error(clean.shapes, s.M), 1e-12);
  EXPECT_LE((modal_masses(clean.shapes, s.M) - VectorX::Ones(15)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((s.rigid.transpose() * (s.M * clean.shapes)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CleanUp, TakesTheNearestOrthonormalSet) {
  // the symmetric root is the polar factor: any other orthonormal set is farther in the metric of M
  const TestStructure s = chassis();
  Modes noisy = s.elastic().lowest(6);
  noisy.shapes += noise(s.n(), 6, 1e-3, 2);
  const MatrixX none(s.n(), 0);
  const MatrixX start = mass_normalised(noisy, s.M).shapes;
  const MatrixX clean = cleaned_up(noisy, s.M, none).shapes;
  const auto distance = [&](const MatrixX& X) { return modal_masses(X - start, s.M).sum(); };
  for (unsigned seed = 3; seed < 8; ++seed) {
    MatrixX Q =
        Eigen::HouseholderQR<MatrixX>(MatrixX::Identity(6, 6) + noise(6, 6, 1e-2, seed)).householderQ();
    for (Eigen::Index j = 0; j < 6; ++j)
      if (Q(j, j) < 0) Q.col(j) *= -1;
    EXPECT_GT(distance(clean * Q), distance(clean));
  }
}

TEST(CleanUp, RefusesRigidAndRepeatedModes) {
  const TestStructure s = chassis();
  EXPECT_THROW(cleaned_up({VectorX::Ones(1), s.rigid.col(2)}, s.M, s.rigid), InputError);
  const MatrixX twice = s.elastic().shapes.col(0).replicate(1, 2);
  EXPECT_THROW(cleaned_up({VectorX::Ones(2), twice}, s.M, s.rigid), InputError);
}

}  // namespace
}  // namespace wishbone
