#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "identification/judgement/mac.h"
#include "identification/judgement/matching.h"
#include "identification/judgement/monte_carlo.h"
#include "identification/methods/released_modes.h"
#include "identification/methods/support_matrices.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

TEST(Mac, IsOneForEqualShapesOfAnyScale) {
  const MatrixX A = chassis().elastic().shapes.leftCols(5);
  const MatrixX mac = modal_assurance(A, -3 * A);
  EXPECT_LE((mac.diagonal() - VectorX::Ones(5)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Mac, IsTheSquaredCosine) {
  MatrixX A(2, 1), B(2, 3);
  A << 1, 0;
  B << 2, 1, 0, /**/ 0, 1, 5;
  const MatrixX mac = modal_assurance(A, B);
  EXPECT_NEAR(mac(0, 0), 1, 1e-15);
  EXPECT_NEAR(mac(0, 1), 0.5, 1e-15);
  EXPECT_EQ(mac(0, 2), 0);
  EXPECT_EQ(modal_assurance(A, MatrixX::Zero(2, 1))(0, 0), 0) << "nothing resembles a shape of zeros";
}

/// An orthogonal matrix by chance.
MatrixX turn(Eigen::Index count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const MatrixX any = MatrixX::NullaryExpr(count, count, [&] { return normal(random); });
  return any.householderQr().householderQ();
}

TEST(Matching, TakesEveryReferenceModeOnceBestFirst) {
  MatrixX shapes(3, 3);
  shapes << 1, 1, 0,  //
      0.5, 0.1, 0,    //
      0, 0, 1;
  const MatrixX reference = MatrixX::Identity(3, 2);
  EXPECT_THAT(match_modes(shapes, reference, Vector3(1, 2, 0).head(2)).partner,
              testing::ElementsAre(-1, 0, -1));
}

TEST(Matching, PairsAllModesOfAGroupHoweverTheyAreTurned) {
  const Modes modes = chassis().elastic().lowest(12);
  VectorX omega = VectorX::LinSpaced(12, 1, 12);
  omega.segment(3, 5) << 4, 4, 4.0001, 4.002, 4.003;
  for (const unsigned seed : {1, 2, 3, 4}) {
    MatrixX shapes = modes.shapes;
    shapes.middleCols(3, 5) *= turn(5, seed);
    const Matching matching = match_modes(shapes, modes.shapes, omega);
    EXPECT_THAT(matching.partner, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
    EXPECT_LE((matching.mac.diagonal() - VectorX::Ones(12)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Matching, PairsTheModesThatWereFoundOfAGroup) {
  const MatrixX reference = chassis().elastic().lowest(8).shapes;
  const VectorX omega = VectorX::Constant(8, 3);
  const MatrixX two = (reference * turn(8, 5)).leftCols(2);
  const Matching matching = match_modes(two, reference, omega);
  EXPECT_THAT(matching.partner, testing::ElementsAre(0, 1));
  EXPECT_LE((matching.mac.leftCols(2).diagonal() - VectorX::Ones(2)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Matching, DoesNotPairWhatLiesOutsideTheGroup) {
  const MatrixX all = chassis().elastic().lowest(9).shapes;
  MatrixX shapes = all.leftCols(5) * turn(5, 6);
  shapes.col(2) = all.col(7);
  const std::vector<int> partner = match_modes(shapes, all.leftCols(5), VectorX::Constant(5, 3)).partner;
  EXPECT_EQ(partner[2], -1);
  EXPECT_EQ(std::count(partner.begin(), partner.end(), -1), 1);
}

TEST(Matching, PairsCloseModesByTheirShapesWhereTheseAreClear) {
  // two of one frequency, turned in their plane, and two close to it; measured in another order
  const MatrixX reference = chassis().elastic().lowest(4).shapes;
  const Eigen::Vector4d omega(1, 1, 1.0002, 1.0009);
  const MatrixX pair = reference.leftCols(2) * turn(2, 3);
  MatrixX shapes(reference.rows(), 4);
  shapes << reference.col(3), pair.col(0), reference.col(2), pair.col(1);
  const Matching clear = match_modes(shapes, reference, omega);
  EXPECT_THAT(clear.partner, testing::ElementsAre(3, 0, 2, 1));
  shapes.col(0) += 0.6 * reference.col(2);  // no longer clear: takes what the others leave
  shapes.col(2) -= 0.1 * reference.col(3);
  const Matching mixed = match_modes(shapes, reference, omega);
  EXPECT_THAT(mixed.partner, testing::ElementsAre(3, 0, 2, 1));
  for (const Matching& matching : {clear, mixed})
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(matching.mac(i, matching.partner[static_cast<std::size_t>(i)]), 1, 1e-12);
}

TEST(Matching, KeepsApartWhatDiffersInFrequency) {
  const MatrixX reference = chassis().elastic().lowest(2).shapes;
  MatrixX shapes(reference.rows(), 2);
  shapes << reference.col(0) + 0.3 * reference.col(1), reference.col(1) - 0.3 * reference.col(0);
  const Matching matching = match_modes(shapes, reference, Eigen::Vector2d(1, 1.01));
  EXPECT_LE(matching.mac(0, 0), 0.95);
}

TEST(MonteCarlo, ScattersAsMeasuredWhenNothingIsDone) {
  const Modes measured = chassis().elastic().lowest(4);
  const MeasurementNoise noise{0.01, 0, 4000, 7};
  const VectorX deviation = frequency_deviation(measured, noise, [](const Modes& m) { return m; });
  // 4000 samples tell a standard deviation to 1.1 %; four times that is allowed
  EXPECT_LE(worst_relative(deviation, 0.01 * measured.frequency_hz()), 0.045);
}

TEST(MonteCarlo, GrowsInProportionToSmallNoise) {
  const TestStructure s = chassis();
  const SupportMatrices held = support_matrices(springs_at({1, 2, 17, 18}, 47e3), s.freedoms());
  const Modes measured = modes_on(s, held).lowest(20);
  const auto identify = [&](const Modes& m) { return release(m, s.M, held, s.rigid, 1e-3).modes; };
  const VectorX small = frequency_deviation(measured, {1e-5, 1e-5, 100, 3}, identify);
  const VectorX large = frequency_deviation(measured, {1e-4, 1e-4, 100, 3}, identify);
  ASSERT_EQ(small.size(), 14);
  EXPECT_TRUE(small.allFinite());
  EXPECT_LE(worst_relative(large.head(8), 10 * small.head(8)), 0.05);
}

TEST(MonteCarlo, RepeatsBitForBit) {
  const Modes measured = chassis().elastic().lowest(4);
  const auto same = [](const Modes& m) { return m; };
  const MeasurementNoise noise{0.01, 0.02, 20, 5};
  EXPECT_EQ(frequency_deviation(measured, noise, same), frequency_deviation(measured, noise, same));
}

}  // namespace
}  // namespace wishbone
