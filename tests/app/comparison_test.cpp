#include "app/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/report_html.h"
#include "app/small_run.h"
#include "app/synthetic_run.h"
#include "core/error.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ComparisonTest : public testing::Test {
 protected:
  Comparison compare_runs(const SmallRun& a, const SmallRun& b,
                          const Choice& choice = {.globs = {}, .all = true}) {
    return compare(ResultFile(a.write(folder_ / "a.h5")), ResultFile(b.write(folder_ / "b.h5")), choice);
  }
  TemporaryFolder folder_;
};

// A: 0 1 2 3 4. B: 0 1 2 3 1. Difference 0 0 0 0 3, mean square 9/5.
TEST_F(ComparisonTest, NumbersAreThoseComputedByHand) {
  SmallRun b;
  b.scalar = [](double t) { return t == 4 ? 1 : t; };
  const Comparison comparison = compare_runs({}, b);
  ASSERT_EQ(comparison.differences.size(), 4u);
  const Difference& d = comparison.differences[0];
  EXPECT_EQ(d.channel.text(), "/group/scalar");
  EXPECT_EQ(d.units, "m");
  EXPECT_EQ(d.max_a, 4);
  EXPECT_EQ(d.max_b, 3);
  EXPECT_EQ(d.max_difference, 3);
  EXPECT_DOUBLE_EQ(d.rms_difference, std::sqrt(9.0 / 5));
  EXPECT_EQ(d.time_of_maximum, 4);
  EXPECT_FALSE(comparison.common_time.interpolated());
  EXPECT_EQ(comparison.differences[2].channel.text(), "/group/vector y");
  EXPECT_EQ(comparison.differences[2].max_difference, 0);
}

// A straight line is the same on any grid; t^2 between 1 and 3 is taken as 5 at t = 2: off by one.
TEST_F(ComparisonTest, OtherInstantsAreInterpolatedLinearlyInTheCommonSpan) {
  SmallRun a;
  a.vector = [](double t) { return std::vector<double>{t * t, 0, 0}; };
  SmallRun b = a;
  b.times = {-1, 1, 3};
  const Comparison comparison = compare_runs(a, b);
  EXPECT_TRUE(comparison.common_time.interpolated());
  EXPECT_EQ(comparison.common_time.time(), VectorX(Eigen::Vector4d(0, 1, 2, 3)));
  EXPECT_EQ(comparison.differences[0].max_difference, 0);
  EXPECT_EQ(comparison.differences[1].max_difference, 1);  // at t = 0: (1 + 1)/2 - 0, and at t = 2
  EXPECT_EQ(comparison.differences[1].time_of_maximum, 0);
  EXPECT_THAT(comparison.common_time.text(), HasSubstr("interpolated"));
}

TEST_F(ComparisonTest, BothSidesOfAJumpAreComparedWithTheirOwn) {
  SmallRun a;
  a.times = {0, 1, 1, 2};
  const auto sides = [] {
    auto row = std::make_shared<int>(0);
    return [row](double) { return (*row)++ < 2 ? 0.0 : 7.0; };
  };
  a.scalar = sides();
  SmallRun b = a;
  b.scalar = sides();
  EXPECT_EQ(compare_runs(a, b).differences[0].max_difference, 0);
}

TEST_F(ComparisonTest, NotANumberIsNotOverlooked) {
  SmallRun b;
  b.scalar = [](double t) { return t == 2 || t == 3 ? NAN : t; };
  const Difference d = compare_runs({}, b).differences[0];
  EXPECT_TRUE(std::isnan(d.max_difference));
  EXPECT_TRUE(std::isnan(d.max_b));
  EXPECT_EQ(d.max_a, 4);
  EXPECT_EQ(d.time_of_maximum, 2);
}

TEST_F(ComparisonTest, SignalsOfOneFileAndOtherUnitsAreListed) {
  SmallRun other;
  other.scalar_path = "/group/other";
  const Comparison missing = compare_runs({}, other);
  EXPECT_THAT(missing.only_in_a, ElementsAre("/group/scalar"));
  EXPECT_THAT(missing.only_in_b, ElementsAre("/group/other"));
  SmallRun millimetres;
  millimetres.units = "mm";
  EXPECT_THAT(compare_runs({}, millimetres).incomparable, ElementsAre(HasSubstr("units 'm' and 'mm'")));
}

TEST_F(ComparisonTest, RunsWithoutCommonTimeAndGlobsWithoutSignalsAreRefused) {
  SmallRun late;
  late.times = {5, 6};
  EXPECT_THROW(compare_runs({}, late), InputError);
  EXPECT_THROW(compare_runs({}, {}, {.globs = {"/tires/*"}, .all = false}), InputError);
}

TEST_F(ComparisonTest, VehicleReportShowsWhatDriversAndEngineersLookAt) {
  write_synthetic_run(folder_ / "rigid.h5", {.flexible = false});
  write_synthetic_run(folder_ / "flexible.h5", {.flexible = true});
  const ResultFile a(folder_ / "rigid.h5");
  const ResultFile b(folder_ / "flexible.h5");
  std::vector<std::string> shown;
  for (const Section& section : choose_sections(a, b, {}))
    for (const Section::Entry& entry : section.entries) shown.push_back(section.heading + ": " + entry.title);
  EXPECT_THAT(
      shown,
      ElementsAre("Path of the chassis: Lateral position", "Path of the chassis: Vertical position",
                  "Vehicle motion: Roll rate", "Vehicle motion: Yaw rate", "Vehicle motion: Side slip",
                  "Vehicle motion: Lateral velocity", "Steering: Steering left", "Steering: Steering right",
                  "Tire deflection: Front left", "Tire deflection: Front right", "Tire deflection: Rear left",
                  "Tire deflection: Rear right", "Deflection of the chassis: Node 19 x",
                  "Deflection of the chassis: Node 19 y", "Deflection of the chassis: Node 19 z",
                  "Deflection of the chassis: Node 20 x", "Deflection of the chassis: Node 20 y",
                  "Deflection of the chassis: Node 20 z"));
}

TEST_F(ComparisonTest, ReportPageLoadsNothing) {
  write_synthetic_run(folder_ / "rigid.h5", {.flexible = false});
  write_synthetic_run(folder_ / "flexible.h5", {.flexible = true});
  const ResultFile a(folder_ / "rigid.h5");
  const ResultFile b(folder_ / "flexible.h5");
  const std::string page = report_html({a, "Rigid </script> & <b>"}, {b, "Flexible"}, compare(a, b, {}));
  for (const char* loads :
       {"<link", "<img", "<iframe", "<script src", "@import", "url(", "http://", "sourceMappingURL"})
    EXPECT_EQ(page.find(loads), std::string::npos) << loads;
  // and the browser is told to refuse whatever the program in the page might try
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none'; "), std::string::npos);
  for (const char* shown :
       {"Rigid &lt;/script&gt; &amp; &lt;b&gt;", "Permission is hereby granted, free of charge",
        "Lateral position", "Only in Flexible: /flexible/chassis/deflection"})
    EXPECT_NE(page.find(shown), std::string::npos) << shown;
  EXPECT_EQ(page.find("Rigid </script>"), std::string::npos);
}

}  // namespace
}  // namespace wishbone
