#include "app/svg/frequency_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/synthetic_identification.h"
#include "app/xml.h"
#include "core/error.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FrequencySvg, HasADotAndABarForEveryModeWithPartner) {
  Judgement judgement = chassis_identification(6).judgement;
  judgement.reference->frequency_error[3] = NAN;
  judgement.reference->partner[3] = -1;
  const std::string svg = frequency_svg(judgement);
  EXPECT_TRUE(is_well_formed_xml(svg));
  EXPECT_FALSE(shows_nan(svg));
  EXPECT_EQ(count_of("<circle", svg), 5u);
  EXPECT_EQ(count_of("<path", svg), 1u);  // the cross
  EXPECT_THAT(svg, HasSubstr("bars: ± one standard deviation; × no reference mode"));
}

TEST(FrequencySvg, LegendNamesOnlyWhatIsThere) {
  Judgement judgement = chassis_identification(6).judgement;
  EXPECT_THAT(frequency_svg(judgement), Not(HasSubstr("no reference mode")));
  judgement.frequency_std_hz.resize(0);
  EXPECT_THAT(frequency_svg(judgement), Not(HasSubstr("bars")));
}

TEST(FrequencySvg, ExactAndUnknownFrequenciesAreDrawn) {
  Judgement judgement = chassis_identification(4).judgement;
  for (const double error : {0.0, 1e-15, static_cast<double>(NAN), 1e6}) {
    judgement.frequency_std_hz.setZero();
    judgement.reference->frequency_error.setConstant(error);
    EXPECT_TRUE(is_well_formed_xml(frequency_svg(judgement)));
    EXPECT_FALSE(shows_nan(frequency_svg(judgement)));
  }
}

TEST(FrequencySvg, RefusesAJudgementWithoutReference) {
  EXPECT_THROW(frequency_svg(Judgement{}), InputError);
}

}  // namespace
}  // namespace wishbone
