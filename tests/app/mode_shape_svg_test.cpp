#include "app/svg/mode_shape_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "app/svg/color_map.h"
#include "app/svg/svg.h"
#include "app/synthetic_identification.h"
#include "app/xml.h"
#include "core/error.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

struct Dot {
  Point at;
  double radius = 0;
  std::string fill;
};

/// Circles of a picture, as written: first the nodes at rest, then the displaced ones.
std::vector<Dot> dots_of(const std::string& svg) {
  static const std::regex kCircle(
      "<circle cx=\"([^\"]*)\" cy=\"([^\"]*)\" r=\"([^\"]*)\"(?: fill=\"([^\"]*)\")?");
  std::vector<Dot> dots;
  for (std::sregex_iterator i(svg.begin(), svg.end(), kCircle), end; i != end; ++i)
    dots.push_back({{std::stod((*i)[1]), std::stod((*i)[2])}, std::stod((*i)[3]), (*i)[4]});
  return dots;
}

double number_after(const std::string& key, const std::string& svg) {
  return std::stod(svg.substr(svg.find(key) + key.size()));
}

/// Corners of all paths, as written.
std::vector<Point> corners_of(const std::string& svg) {
  static const std::regex kCorner("[ML](-?[0-9.]+) (-?[0-9.]+)");
  std::vector<Point> corners;
  for (std::sregex_iterator i(svg.begin(), svg.end(), kCorner), end; i != end; ++i)
    corners.emplace_back(std::stod((*i)[1]), std::stod((*i)[2]));
  return corners;
}

void expect_inside(const std::string& svg) {
  const Point size(number_after(" width=\"", svg), number_after(" height=\"", svg));
  for (const Dot& dot : dots_of(svg)) {
    EXPECT_GE((dot.at.array() - dot.radius).minCoeff(), 0);
    EXPECT_LE((dot.at + Point::Constant(dot.radius) - size).maxCoeff(), 0);
  }
  for (const Point& corner : corners_of(svg)) {
    EXPECT_GE(corner.minCoeff(), 0);
    EXPECT_LE((corner - size).maxCoeff(), 0);
  }
}

TEST(ModeShapeSvg, IsWellFormedTitledAndTheSameEveryTime) {
  ModalData data = chassis_modes(3);
  data.title = "<chassis>";
  data.support.springs.push_back({1, Vector3::UnitZ(), 1e4});
  data.support.joints.push_back({20, Vector3(0.6, 0.8, 0)});
  data.support.masses.push_back({7, 2});
  const std::string svg = mode_shape_svg(data, 2);
  EXPECT_TRUE(is_well_formed_xml(svg));
  EXPECT_THAT(svg, HasSubstr("Mode 3 · 20.66 Hz"));
  EXPECT_FALSE(shows_nan(svg));
  EXPECT_EQ(svg, mode_shape_svg(data, 2));
  EXPECT_TRUE(is_well_formed_xml(mode_sheet_svg(data, 3)));
}

TEST(ModeShapeSvg, LargestDisplacementHasTheLastColourAndEveryNodeIsDrawnTwice) {
  const ModalData data = chassis_modes(1);
  const std::vector<Dot> dots = dots_of(mode_shape_svg(data, 0));
  ASSERT_EQ(dots.size(), 40u);
  Eigen::Index largest = 0;
  data.shapes.col(0).reshaped(3, 20).colwise().norm().maxCoeff(&largest);
  EXPECT_EQ(dots[20 + largest].fill, kDisplacementColors.at(1));
}

// The elevation of the view shortens z by its cosine, for structure and displacement alike; the vertical edges
// of the block give the scale.
TEST(ModeShapeSvg, MotionMeasuredAlongZIsDrawnUprightAtItsScale) {
  const ModalData data = measured_along(chassis_modes(2), 2);
  const ModeShapeOptions options{.width = 640, .amplitude = 0.15};
  for (int mode = 0; mode < 2; ++mode) {
    const std::vector<Dot> dots = dots_of(mode_shape_svg(data, mode, options));
    ASSERT_EQ(dots.size(), 40u);
    const double pixels_per_metre =
        (dots[1].at - dots[2].at).norm() / 0.4;  // nodes 2 and 3 are one edge in z
    ASSERT_NEAR(dots[1].at.x(), dots[2].at.x(), 0.011);
    double largest = 0;
    for (int i = 0; i < 20; ++i) {
      EXPECT_NEAR(dots[i].at.x(), dots[20 + i].at.x(), 0.011);  // two decimals each
      const double drawn = (dots[i].at.y() - dots[20 + i].at.y()) / pixels_per_metre;
      const double shape = data.shapes(i, mode) / data.shapes.col(mode).cwiseAbs().maxCoeff();
      EXPECT_NEAR(drawn, 0.15 * Vector3(2.4, 0.4, 0.4).norm() * shape, 1e-3);
      largest = std::max(largest, std::abs(drawn));
    }
    EXPECT_NEAR(largest, 0.15 * Vector3(2.4, 0.4, 0.4).norm(), 1e-3);
  }
}

TEST(ModeShapeSvg, SlenderBodiesFillTheWidthInEitherDirection) {
  for (const auto& data : {chassis_modes(1), block_modes({0.4, 2.4, 0.4}, {1, 4, 1}, 1)}) {
    const std::vector<Dot> dots = dots_of(mode_shape_svg(data, 0, {.width = 640}));
    const auto [left, right] = std::minmax_element(
        dots.begin(), dots.end(), [](const Dot& a, const Dot& b) { return a.at.x() < b.at.x(); });
    EXPECT_GT(right->at.x() - left->at.x(), 0.9 * 640);
  }
}

TEST(ModeShapeSvg, NothingLeavesThePaper) {
  ModalData supported = chassis_modes(6);
  supported.support.joints.push_back({3, Vector3::UnitX()});
  ModalData cloud = chassis_modes(6);
  cloud.lines.clear();
  for (const ModalData& data :
       {supported, cloud, measured_along(block_modes({1.2, 0.8, 0.02}, {6, 4, 1}, 6), 2),
        block_modes({0.4, 0.4, 2.4}, {1, 1, 4}, 6)}) {
    for (int mode = 0; mode < 6; ++mode) expect_inside(mode_shape_svg(data, mode));
    expect_inside(mode_sheet_svg(data, 6));
  }
}

TEST(ModeShapeSvg, AModeThatMovesNothingStaysInPlace) {
  ModalData data = chassis_modes(1);
  data.shapes.setZero();
  const std::string svg = mode_shape_svg(data, 0);
  EXPECT_FALSE(shows_nan(svg));
  const std::vector<Dot> dots = dots_of(svg);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(dots[i].at, dots[20 + i].at);
}

TEST(ModeShapeSvg, StructuresWithoutExtentAreDrawn) {
  ModalData data = chassis_modes(1);
  data.lines.clear();
  data.node_position.setConstant(0.3);
  data.support.springs.push_back({1, Vector3::UnitX(), 1});
  const std::string svg = mode_shape_svg(data, 0);
  EXPECT_TRUE(is_well_formed_xml(svg));
  EXPECT_FALSE(shows_nan(svg));
  expect_inside(svg);
}

TEST(ModeShapeSvg, WithoutLinesNeighboursAreJoinedAndThePictureSaysSo) {
  ModalData data = chassis_modes(1);
  const std::string given = mode_shape_svg(data, 0);
  data.lines.clear();
  const std::string guessed = mode_shape_svg(data, 0);
  EXPECT_EQ(count_of("<path", guessed), count_of("<path", given));  // the neighbours of a block are its edges
  EXPECT_THAT(guessed, HasSubstr("lines join neighbours"));
  EXPECT_THAT(given, testing::Not(HasSubstr("lines join neighbours")));
}

TEST(ModeShapeSvg, EveryPartOfTheSupportHasItsSymbol) {
  ModalData data = chassis_modes(1);
  const std::string free = mode_shape_svg(data, 0);
  data.support.joints = {{1, Vector3::UnitX()}, {1, Vector3::UnitY()}, {9, -Vector3::UnitZ()}};
  EXPECT_EQ(count_of("Z\"", mode_shape_svg(data, 0)), 3u);  // closed triangles
  data.support = {};
  data.support.masses = {{1, 2}, {5, 2}};
  EXPECT_EQ(count_of("<rect", mode_shape_svg(data, 0)), count_of("<rect", free) + 2);
  data.support = {};
  data.support.springs = {{1, Vector3::UnitZ(), 1}};
  EXPECT_EQ(count_of("<path", mode_shape_svg(data, 0)),
            count_of("<path", free) + 3);  // zigzag, ground, hatches
}

TEST(ModeShapeSvg, SheetHasAsManyModesAsThereAre) {
  const ModalData data = chassis_modes(5);
  EXPECT_EQ(count_of(" Hz · ζ", mode_sheet_svg(data, 4)), 4u);
  EXPECT_EQ(count_of(" Hz · ζ", mode_sheet_svg(data, 12)), 5u);
  EXPECT_EQ(count_of(" Hz · ζ", mode_sheet_svg(data, 0)), 0u);
  EXPECT_TRUE(is_well_formed_xml(mode_sheet_svg(ModalData{}, 3)));
}

TEST(ModeShapeSvg, RefusesAModeThatIsNotThereAndDataThatAreNotValid) {
  ModalData data = chassis_modes(2);
  EXPECT_THROW(mode_shape_svg(data, 2), InputError);
  EXPECT_THROW(mode_shape_svg(data, -1), InputError);
  data.shapes(0, 0) = NAN;
  EXPECT_THROW(mode_shape_svg(data, 0), InputError);
  EXPECT_THROW(mode_sheet_svg(data, 2), InputError);
}

}  // namespace
}  // namespace wishbone
