// Scatter of shapes that was put in comes out again.
#include "identification/methods/shape_scatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "identification/measured.h"
#include "identification/methods/support_matrices.h"

namespace wishbone {
namespace {

MatrixX scattered(MatrixX shapes, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
    const double rms = shapes.col(j).norm() / std::sqrt(static_cast<double>(shapes.rows()));
    for (double& x : shapes.col(j)) x += size * rms * normal(random);
  }
  return shapes;
}

/// With `digits` decimal digits each.
MatrixX written(const MatrixX& shapes, int digits) {
  return shapes.unaryExpr([digits](double x) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) + 1 - digits);
    return x == 0 ? 0 : std::round(x / unit) * unit;
  });
}

struct Measurement {
  TestStructure s;
  SupportMatrices support;
  Modes modes;

  Measurement(TestStructure structure, const Support& on, Eigen::Index count)
      : s(std::move(structure)), support(support_matrices(on, s.freedoms())) {
    const ModalData data = measured_on(s, on, count);
    modes = {data.omega.cwiseAbs2(), data.shapes};
  }
  double estimate(const MatrixX& shapes) const {
    return shape_scatter({modes.lambda, shapes}, s.M, support, s.rigid).size;
  }
};

std::vector<Measurement> tests() {
  std::vector<Measurement> tests;
  tests.emplace_back(chassis(), chassis_springs_with_masses(), 30);
  tests.emplace_back(chassis(), chassis_joints(), 20);
  tests.emplace_back(slender_block(), Support{}, 15);
  tests.emplace_back(l_shape(), springs_at({101, 104, 110, 115}, 5e4), 25);
  tests.emplace_back(random_lumped(9, 4), springs_at({1, 2, 3, 4}, 2e4), 27);
  return tests;
}

TEST(ShapeScatter, IsFoundFromTheModesThemselves) {
  for (const Measurement& test : tests())
    for (const double size : {1e-4, 1e-3, 1e-2, 5e-2}) {
      constexpr int kRepetitions = 20;
      double mean = 0;
      for (unsigned seed = 1; seed <= kRepetitions; ++seed) {
        const double ratio = test.estimate(scattered(test.modes.shapes, size, seed)) / size;
        mean += ratio / kRepetitions;
        EXPECT_GT(ratio, 0.6) << size << " of " << test.s.n();
        EXPECT_LT(ratio, 1.5) << size << " of " << test.s.n();
      }
      EXPECT_NEAR(mean, 1, 0.06) << size << " of " << test.s.n();
      RecordProperty("mean of " + std::to_string(test.s.n()) + " at " + std::to_string(size),
                     std::to_string(mean));
    }
}

TEST(ShapeScatter, IsNoneOfExactShapes) {
  for (const Measurement& test : tests()) EXPECT_LE(test.estimate(test.modes.shapes), 1e-9);
}

TEST(ShapeScatter, IsNotMisledByASpringThatIsStatedWrongly) {
  Measurement test(chassis(), chassis_springs(), 30);
  test.support.K_s *= 1.2;
  EXPECT_NEAR(test.estimate(scattered(test.modes.shapes, 1e-2, 3)), 1e-2, 2e-3);
}

TEST(ShapeScatter, KnowsTheDigitsThatWereWritten) {
  const Measurement test(chassis(), chassis_springs(), 30);
  for (const int digits : {3, 4, 5, 6}) {
    const MatrixX shapes = written(test.modes.shapes, digits);
    const double error =
        (shapes - test.modes.shapes).colwise().norm().cwiseQuotient(shapes.colwise().norm()).mean();
    EXPECT_GT(written_scatter(shapes), 0.5 * error) << digits;
    EXPECT_LT(written_scatter(shapes), 2 * error) << digits;
    EXPECT_GT(test.estimate(shapes), 0.3 * error) << digits;
    EXPECT_LT(test.estimate(shapes), 3 * error) << digits;
    EXPECT_NEAR(written_scatter(25.4 * shapes), 0, 1e-5) << "of another unit";
  }
  EXPECT_EQ(written_scatter(test.modes.shapes), 0);
}

TEST(ShapeScatter, TakesExactNumbersOfFewDigitsForExact) {
  MatrixX shapes(3, 2);  // of three equal masses along x
  shapes << 1, 1, 0, -2, -1, 1;
  const SupportMatrices none{SparseMatrix(3, 3), SparseMatrix(3, 3), SparseMatrix(0, 3)};
  const MatrixX rigid = Vector3::Constant(1 / std::sqrt(3.0));
  EXPECT_GT(written_scatter(shapes), 0.1);
  EXPECT_LE(
      shape_scatter({Eigen::Vector2d(1, 3), shapes}, diagonal_matrix(Vector3::Ones()), none, rigid).size,
      1e-12);
}

}  // namespace
}  // namespace wishbone
