#include "forces/road/road.h"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::kDegree;
using testing::message_of;
using testing::Random;

const RoadDepression kDepression{7.2, 12.0, 0.03};

TEST(Road, LevelPlaneIsZeroEverywhere) {
  const Road road;
  EXPECT_EQ(road.segment_count(), 1);
  const RoadPoint p = road.at(17.0, -4.0, 0);
  EXPECT_EQ(p.height, 0.0);
  EXPECT_EQ(p.uz, Vector3::UnitZ());
}

TEST(Road, SegmentsFollowTheDepressions) {
  const Road road(0.0, {kDepression, {19.2, 1.0, 0.1}, {30.0, 1.0, -0.1}});
  ASSERT_EQ(road.segment_count(), 6);  // flat, depression, touching depression, flat, bump, flat
  EXPECT_EQ(road.lower_edge(0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(road.upper_edge(5), std::numeric_limits<double>::infinity());
  for (int s = 0; s + 1 < road.segment_count(); ++s) EXPECT_EQ(road.upper_edge(s), road.lower_edge(s + 1));
  EXPECT_EQ(road.segment_at(-1e9), 0);
  EXPECT_EQ(road.segment_at(std::nextafter(7.2, 0.0)), 0);
  EXPECT_EQ(road.segment_at(7.2), 1);
  EXPECT_EQ(road.segment_at(19.2), 2);
  EXPECT_EQ(road.segment_at(25.0), 3);
  EXPECT_EQ(road.segment_at(30.5), 4);
  EXPECT_EQ(road.segment_at(1e9), 5);
}

TEST(Road, DepressionIsDeepestInItsMiddle) {
  const Road road(6 * kDegree, {kDepression});
  const double bank = 0.7 * std::tan(6 * kDegree);
  EXPECT_NEAR(road.at(13.2, 0.7, 1).height, bank - 0.03, 1e-15);
  EXPECT_NEAR(road.at(9.2, 0.7, 1).height, bank - 0.015, 1e-15);  // sin(30 deg) = 1/2
}

TEST(Road, HeightIsContinuousAndSlopeJumpsAtTheEdges) {
  const Road road(0.0, {kDepression});
  const double slope = 0.03 * std::numbers::pi / 12.0;
  for (const double edge : {road.lower_edge(1), road.upper_edge(1)})
    EXPECT_NEAR(road.at(edge, 0, 1).height, 0, 1e-16);
  EXPECT_NEAR(road.at(7.2, 0, 1).slope_x, -slope, 1e-16);
  EXPECT_NEAR(road.at(19.2, 0, 1).slope_x, slope, 1e-16);
  EXPECT_EQ(road.at(7.2, 0, 0).slope_x, 0.0);
}

TEST(Road, SegmentContinuesItsFormulaBeyondItsEdges) {
  const Road road(0.0, {kDepression});
  // the sine is odd about its ends: what was a depression goes on as a bump
  for (const double x : {0.001, 0.5, 3.0}) {
    EXPECT_NEAR(road.at(7.2 - x, 0, 1).height, -road.at(7.2 + x, 0, 1).height, 1e-15);
    EXPECT_NEAR(road.at(19.2 + x, 0, 1).height, -road.at(19.2 - x, 0, 1).height, 1e-15);
    EXPECT_EQ(road.at(7.2 + x, 0, 0).height, 0.0);
  }
}

TEST(Road, NormalIsUnitUpwardAndPerpendicularToTheSurface) {
  const Road road(6 * kDegree, {kDepression});
  Random random(1);
  const double h = 1e-4;
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(5, 22), y = random.uniform(-3, 3);
    const int segment = road.segment_at(x);
    const auto height = [&](double dx, double dy) { return road.at(x + dx, y + dy, segment).height; };
    const Vector3 along_x(2 * h, 0, height(h, 0) - height(-h, 0));
    const Vector3 along_y(0, 2 * h, height(0, h) - height(0, -h));
    const RoadPoint p = road.at(x, y, segment);
    EXPECT_LT((p.uz - along_x.cross(along_y).normalized()).norm(), 1e-11);
    EXPECT_NEAR(p.slope_x, along_x.z() / (2 * h), 1e-11);
    EXPECT_NEAR(p.slope_y, along_y.z() / (2 * h), 1e-11);
  }
}

TEST(Road, RejectsBadInput) {
  using ::testing::HasSubstr;
  EXPECT_THAT(message_of<InputError>([] {
                Road(0, {{0, 2, 0.1}, {1, 2, 0.1}});
              }),
              HasSubstr("without overlap (got 1)"));
  EXPECT_THAT(message_of<InputError>([] { Road(0, {{0, 0, 0.1}}); }), HasSubstr("positive length"));
  EXPECT_THAT(message_of<InputError>([] { Road(1.6, {}); }), HasSubstr("quarter turn"));
}

}  // namespace
}  // namespace wishbone
