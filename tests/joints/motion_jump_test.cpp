#include "joints/motion_jump.h"

#include <gtest/gtest.h>

#include <string>

namespace wishbone {
namespace {

MotionJumps jumps_of(const std::string& law, double duration = 1) {
  return find_jumps(Motion("m", Function(Expression(law, {"t"}))), duration, 1e-6, 1e-8);
}

TEST(MotionJump, IsFoundWithItsTimeAndBothValues) {
  const MotionJumps jumps = jumps_of("t > 0.3 ? 2*t : 5");
  ASSERT_TRUE(jumps.position);
  EXPECT_DOUBLE_EQ(jumps.position->time, 0.3);
  EXPECT_DOUBLE_EQ(jumps.position->before, 5);
  EXPECT_DOUBLE_EQ(jumps.position->after, 0.6);
}

TEST(MotionJump, OfTheRateAloneIsACorner) {
  const MotionJumps jumps = jumps_of("abs(t - 0.7)");
  EXPECT_FALSE(jumps.position);
  ASSERT_TRUE(jumps.rate);
  EXPECT_NEAR(jumps.rate->time, 0.7, 1e-15);
  EXPECT_DOUBLE_EQ(jumps.rate->height(), 2);
}

TEST(MotionJump, IsFoundWithinPulsesMuchShorterThanTheRun) {
  const MotionJumps jumps = jumps_of("t > 700.1 && t < 700.100001 ? 1 : 0", 1000);
  ASSERT_TRUE(jumps.position);
  EXPECT_NEAR(jumps.position->time, 700.1, 1e-9);
}

TEST(MotionJump, IsNotSeenInWhatIsSteepFastOrBentButContinuous) {
  for (const char* law :
       {"tanh((t - 0.5)/1e-9)", "sin(1e6*t)", "1e6*exp(10*t)", "step(t, 0.5, 0, 0.5000001, 1)",
        "t < 0.5 ? 0 : (t - 0.5)^2", "sqrt(t + 1e-12)", "t < 0.5 ? 1 : 1 + 1e-9"}) {
    const MotionJumps jumps = jumps_of(law);
    EXPECT_FALSE(jumps.position) << law << " at " << jumps.position->time;
    EXPECT_FALSE(jumps.rate) << law << " at " << jumps.rate->time;
  }
}

TEST(MotionJump, EndsItsSearchWhereTheMotionIsUndefined) {
  const MotionJumps jumps = jumps_of("sqrt(0.5 - t) + (t > 0.6)");
  EXPECT_FALSE(jumps.position);
}

}  // namespace
}  // namespace wishbone
