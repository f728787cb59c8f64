#include "solver/singular_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace wishbone {
namespace {

/// Steps of 10 ms over a sine that depends on time.
SingularWatch watch(const std::function<double(double)>& sine, int steps) {
  SingularWatch watch;
  ClosureFactor closure;
  closure.least_row = 3;
  for (int i = 0; i < steps; ++i) {
    closure.least_sine = sine(0.01 * i);
    watch.observe(0.01 * i, closure);
  }
  return watch;
}

TEST(SingularWatch, FindsWhereTheSineFallsToZeroAndRisesAgain) {
  const auto sine = [](double t) { return std::abs(std::sin(5 * (t - 0.1234))); };
  const auto passages = watch(sine, 30).passages();
  ASSERT_EQ(passages.size(), 1U);
  EXPECT_NEAR(passages[0].t, 0.1234, 1e-4);
  EXPECT_EQ(passages[0].row, 3);
}

TEST(SingularWatch, IsNotDeceivedByAPositionThatOnlyComesClose) {
  const auto sine = [](double t) { return std::hypot(0.05, 5 * (t - 0.1234)); };
  EXPECT_TRUE(watch(sine, 30).passages().empty());
}

// The rows of a clamped frame stay close to dependent while it vibrates, about the sine that counts as touching, or in
// vibrations that steps hardly resolve.
TEST(SingularWatch, IsNotDeceivedByRowsThatAreAlwaysCloseToDependent) {
  EXPECT_TRUE(watch([](double t) { return 1e-4 * (1 + 0.5 * std::sin(70 * t)); }, 300).passages().empty());
  EXPECT_TRUE(watch([](double t) { return 1e-4 * (1.1 + std::sin(1000 * t)); }, 300).passages().empty());
  EXPECT_TRUE(watch([](double t) { return 3e-3 * (1.05 + std::sin(270 * t)); }, 300).passages().empty());
}

TEST(SingularWatch, FindsASecondPassageAfterOneThatAStepLandedOn) {
  const auto sine = [](double t) { return std::abs(std::sin(10 * (t - 0.1))); };  // at 0.1 and 0.4142
  const auto passages = watch(sine, 60).passages();
  ASSERT_EQ(passages.size(), 2U);
  EXPECT_NEAR(passages[0].t, 0.1, 1e-9);
  EXPECT_NEAR(passages[1].t, 0.1 + 0.314159, 1e-3);
}

TEST(SingularWatch, ExpectsTheZeroAlongTheLineThroughTwoSteps) {
  const auto sine = [](double t) { return std::abs(5 * (t - 0.1234)); };
  EXPECT_NEAR(watch(sine, 10).expected(), 0.1234, 1e-12);
}

TEST(SingularWatch, ExpectsNothingFarFromSingularOrOnTheWayOut) {
  const auto sine = [](double t) { return std::abs(5 * (t - 0.1234)); };
  EXPECT_TRUE(std::isinf(watch(sine, 2).expected()));   // sine 0.57
  EXPECT_TRUE(std::isinf(watch(sine, 15).expected()));  // rises
}

}  // namespace
}  // namespace wishbone
