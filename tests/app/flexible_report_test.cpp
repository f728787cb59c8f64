// Reports on flexible bodies: signals of many numbers become a few plots, one chart, and a whole table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "app/comparison.h"
#include "app/report_html.h"
#include "app/wide_signal.h"
#include "app/xml.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr int kModes = 54;

/// Two rows of a flexible frame: mode j (from 1) has the energy `scale`/j^2 in the second, of nodes 1, 2, 3 the last bends most.
std::string write_run(const std::string& path, double scale = 1) {
  Recorder recorder(
      path, {{"/flexible/frame/modal_strain_energy", {kModes}, "J", "", "of each mode", {}},
             {"/flexible/frame/strain_energy", {}, "J", "", "of the body", {}},
             {"/flexible/frame/interface_force", {3, 3}, "N", "body", "", {{"nodes", {"1", "2", "3"}}}},
             {"/recovery/stress", {5}, "MPa", "", "", {{"rows", {"a", "b", "c", "d", "e"}}}}});
  for (const double t : {0.0, 1.0}) {
    std::vector<double> row;
    for (int j = 1; j <= kModes; ++j) row.push_back(scale * t / (j * j));
    row.push_back(2 * t);
    for (int i = 1; i <= 9; ++i) row.push_back(i * t);
    for (const double stress : {1, -9, 3, 4, 5}) row.push_back(stress * t);
    recorder.append(t, row);
  }
  recorder.close(Outcome::kComplete);
  return path;
}

class FlexibleReport : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const ResultFile a_{write_run(folder_ / "a.h5")}, b_{write_run(folder_ / "b.h5", 2)};
};

std::vector<std::string> plots(const std::vector<Section>& sections) {
  std::vector<std::string> shown;
  for (const Section& section : sections)
    for (const Section::Entry& entry : section.entries)
      if (entry.plotted) shown.push_back(section.heading + ": " + entry.title);
  return shown;
}

TEST_F(FlexibleReport, ShowsTheStrongestModesTheLargestForcesAndStresses) {
  EXPECT_THAT(
      plots(choose_sections(a_, b_, {})),
      ElementsAre("Energy of the frame: Strain energy", "Energy of the frame: Strain energy of mode 1",
                  "Energy of the frame: Strain energy of mode 2",
                  "Energy of the frame: Strain energy of mode 3",
                  "Energy of the frame: Strain energy of mode 4", "Interface forces of the frame: Node 2 x",
                  "Interface forces of the frame: Node 2 y", "Interface forces of the frame: Node 2 z",
                  "Interface forces of the frame: Node 3 x", "Interface forces of the frame: Node 3 y",
                  "Interface forces of the frame: Node 3 z", "Recovered stress: B", "Recovered stress: C",
                  "Recovered stress: D", "Recovered stress: E"));
}

TEST_F(FlexibleReport, OfAllSignalsPlotsTheLargestAndComparesEveryNumber) {
  const Comparison all = compare(a_, b_, {.globs = {}, .all = true});
  EXPECT_EQ(all.differences.size(), kModes + 1 + 9 + 5u);
  EXPECT_EQ(plots(all.sections).size(), 4 + 1 + 6 + 4u);
  std::map<std::string, double> largest;
  for (const Difference& d : all.differences) largest[d.channel.text()] = d.max_difference;
  EXPECT_DOUBLE_EQ(largest.at("/flexible/frame/modal_strain_energy 54"), 1.0 / (kModes * kModes));
  EXPECT_TRUE(largest.contains("/recovery/stress b"));
}

TEST_F(FlexibleReport, ChartsThePeakOfEveryMode) {
  const std::vector<Section> sections = choose_sections(a_, b_, {});
  ASSERT_EQ(sections[0].charts.size(), 1u);
  const PeakChart& chart = sections[0].charts[0];
  EXPECT_EQ(chart.title, "Peak of the strain energy of the frame by mode");
  EXPECT_EQ(chart.unit, "J");
  ASSERT_EQ(chart.values[0].size(), kModes);
  EXPECT_DOUBLE_EQ(chart.values[0][2], 1.0 / 9);
  EXPECT_DOUBLE_EQ(chart.values[1][2], 2.0 / 9);
}

TEST_F(FlexibleReport, PageTellsWhatItLeavesOut) {
  const auto page = [&](const Choice& choice) {
    return report_html({a_, "A"}, {b_, "B"}, compare(a_, b_, choice));
  };
  const std::string all = page({.globs = {}, .all = true});
  EXPECT_THAT(all, HasSubstr("11 of 64 curves are plotted"));
  EXPECT_THAT(all, HasSubstr("Peak of the strain energy of the frame by mode"));
  EXPECT_THAT(all, HasSubstr("/flexible/frame/modal_strain_energy 54"));
  EXPECT_THAT(page({}), Not(HasSubstr("curves are plotted")));
}

TEST_F(FlexibleReport, SignalsOfFewNumbersAreShownWhole) {
  const Signal few{"/a", {4}, "1", "", "", {}}, vector{"/a", {3}, "m", "world", "", {}},
      nodes{"/a", {2, 3}, "m", "body", "", {}};
  EXPECT_THAT(notable_components(few, a_, b_), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(notable_components(vector, a_, b_), ElementsAre(0, 1, 2));
  EXPECT_EQ(notable_components(nodes, a_, b_).size(), 6u);
}

TEST_F(FlexibleReport, NumbersThatAreNoneAreShownFirst) {
  const std::string path = folder_ / "nan.h5";
  {
    Recorder recorder(path, {{"/x/y", {6}, "1", "", "", {}}});
    recorder.append(0, std::vector<double>{9, 8, 7, 6, 5, 1});
    recorder.append(1, std::vector<double>{9, 8, 7, 6, 5, NAN});
    recorder.close(Outcome::kComplete);
  }
  const ResultFile file(path);
  EXPECT_THAT(notable_components(*file.find("/x/y"), file, file), ElementsAre(0, 1, 2, 5));
}

TEST(PeakChart, HasABarForEveryValueWithinSixDecades) {
  PeakChart chart{"peaks", "J", "mode", {VectorX(4), VectorX(3)}};
  chart.values[0] << 50, 1e-3, 1e-5, 0;
  chart.values[1] << NAN, 20, INFINITY;
  const std::string svg = peak_chart_svg(chart);
  EXPECT_TRUE(is_well_formed_xml(svg));
  EXPECT_FALSE(shows_nan(svg));
  EXPECT_EQ(count_of("<rect", svg), 3u);  // 50 and 0.001 (of 100 to 0.0001), 20
  EXPECT_THAT(svg, HasSubstr(">100<"));
  EXPECT_THAT(svg, HasSubstr(">0.0001<"));
}

TEST(PeakChart, OfNothingIsDrawn) {
  for (const VectorX& values : {VectorX(), VectorX(VectorX::Zero(3))}) {
    const std::string svg = peak_chart_svg({"peaks", "J", "mode", {values, VectorX()}});
    EXPECT_TRUE(is_well_formed_xml(svg));
    EXPECT_EQ(count_of("<rect", svg), 0u);
  }
}

}  // namespace
}  // namespace wishbone
