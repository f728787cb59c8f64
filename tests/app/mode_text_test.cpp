#include "app/mode_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/synthetic_identification.h"

namespace wishbone {
namespace {

TEST(ModeText, NumbersHaveTheirSignificantDigitsAndNoExponent) {
  EXPECT_EQ(significant_text(17.3456, 4), "17.35");
  EXPECT_EQ(significant_text(9.99996, 4), "10.00");
  EXPECT_EQ(significant_text(123456.7, 4), "123457");
  EXPECT_EQ(significant_text(0.0012345, 3), "0.00123");
  EXPECT_EQ(significant_text(0, 3), "0.00");
  EXPECT_EQ(significant_text(NAN, 4), "–");
}

TEST(ModeText, PercentsKeepWhatIsSmall) {
  EXPECT_EQ(percent_text(0.0123), "1.23");
  EXPECT_EQ(percent_text(-0.00015), "-0.01");
  EXPECT_EQ(percent_text(3.2e-9), "3.2e-07");
  EXPECT_EQ(percent_text(0), "0.00");
  EXPECT_EQ(percent_text(NAN), "–");
  EXPECT_EQ(percent_text(-INFINITY), "–");
}

// The chassis bends first at 17.35 Hz; its damping is set.
TEST(ModeText, TitleTellsNumberFrequencyAndDamping) {
  ModalData data = chassis_modes(3);
  EXPECT_EQ(mode_title(data, 0), "Mode 1 · 17.35 Hz · ζ 1.2 %");
  data.damping_ratio.setZero();
  EXPECT_EQ(mode_title(data, 2), "Mode 3 · 20.66 Hz");
  EXPECT_THAT(mode_labels(frequencies_hz(data.omega)),
              testing::ElementsAre("1 · 17.35", "2 · 17.35", "3 · 20.66"));
}

}  // namespace
}  // namespace wishbone
