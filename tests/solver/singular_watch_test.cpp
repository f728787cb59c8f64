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
