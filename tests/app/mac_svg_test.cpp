#include "app/svg/mac_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/svg/color_map.h"
#include "app/xml.h"
#include "core/error.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::Not;

MacAxis axis(Eigen::Index count, const std::string& name) {
  MacAxis axis{name, {}};
  for (Eigen::Index i = 0; i < count; ++i) axis.labels.push_back(name[0] + std::to_string(100 + i));
  return axis;
}

std::string picture(const MatrixX& mac) {
  return mac_svg(mac, axis(mac.rows(), "identified"), axis(mac.cols(), "reference"), "MAC <of> a & b");
}

TEST(MacSvg, IsWellFormedWithTitleLabelsAndNames) {
  const std::string svg = picture(MatrixX::Identity(3, 4));
  EXPECT_TRUE(is_well_formed_xml(svg));
  for (const char* shown :
       {"MAC &lt;of&gt; a &amp; b", ">i100<", ">i102<", ">r103<", ">identified<", ">reference<"})
    EXPECT_THAT(svg, HasSubstr(shown));
  EXPECT_EQ(svg, picture(MatrixX::Identity(3, 4)));
}

TEST(MacSvg, ValuesStandInTheCellsWhileThereIsRoom) {
  MatrixX mac = MatrixX::Zero(20, 20);
  mac(3, 5) = 0.874;
  mac(6, 6) = 1;
  const std::string svg = picture(mac);
  EXPECT_EQ(count_of(">.87</text>", svg), 1u);
  EXPECT_EQ(count_of(">1</text>", svg), 1u + 1u);  // the cell and the colour bar
  EXPECT_EQ(count_of(">0</text>", svg), 398u + 1u);
  mac.conservativeResizeLike(MatrixX::Zero(21, 20));
  EXPECT_THAT(picture(mac), Not(HasSubstr(">.87</text>")));
}

TEST(MacSvg, CellsHaveTheColourOfTheirValue) {
  MatrixX mac = MatrixX::Zero(30, 30);
  mac(0, 0) = 0.6;
  EXPECT_EQ(count_of("fill=\"" + kShareColors.at(0.6) + '"', picture(mac)), 1u);
}

TEST(MacSvg, WhatIsNotANumberIsAGreyCell) {
  MatrixX mac = MatrixX::Identity(4, 4);
  mac.row(2).setConstant(NAN);
  const std::string svg = picture(mac);
  EXPECT_FALSE(shows_nan(svg));
  EXPECT_EQ(count_of("fill=\"#d5d9df\"", svg), 4u);
  EXPECT_EQ(count_of(">–</text>", svg), 4u);
}

TEST(MacSvg, OfManyLabelsSomeAreLeftOutAndTheRestDoNotTouch) {
  const std::string svg = picture(MatrixX::Identity(60, 60));
  EXPECT_EQ(count_of(">i1", svg), 30u);
  EXPECT_EQ(count_of(">r1", svg), 30u);
  EXPECT_THAT(svg, Not(HasSubstr(">i101<")));
}

TEST(MacSvg, EmptyMatrixIsAnEmptyPicture) {
  for (const MatrixX& mac : {MatrixX(0, 0), MatrixX(0, 5), MatrixX(5, 0)}) {
    EXPECT_TRUE(is_well_formed_xml(picture(mac)));
    EXPECT_FALSE(shows_nan(picture(mac)));
  }
}

TEST(MacSvg, RefusesLabelsThatDoNotFit) {
  EXPECT_THROW(mac_svg(MatrixX::Identity(3, 3), axis(3, "a"), axis(2, "b"), ""), InputError);
  EXPECT_THROW(mac_svg(MatrixX::Identity(3, 3), axis(4, "a"), axis(3, "b"), ""), InputError);
}

}  // namespace
}  // namespace wishbone
