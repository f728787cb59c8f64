#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "identification/judgement/mac.h"
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

TEST(Partners, AreTakenOnceBestFirst) {
  MatrixX mac(3, 3);
  mac << 0.9, 0.8, 0.0,  //
      0.95, 0.5, 0.0,    //
      0.1, 0.2, 0.3;
  EXPECT_THAT(partners(mac), testing::ElementsAre(1, 0, -1));
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
