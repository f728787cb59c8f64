#include "identification/judgement/body_extent.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "identification/identify.h"
#include "identification/measured.h"

namespace wishbone {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Nodes at the corners of a block with equal masses: inertia m (b^2 + c^2) / 4 about x and so on.
TEST(BodyExtent, OfMassesAtTheCornersOfABlock) {
  ModalData data;
  data.node_position.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    data.node_ids.push_back(i + 1);
    data.node_position.col(i) = Vector3(1 + 2 * (i & 1), (i >> 1) & 1, 0.5 * ((i >> 2) & 1));
  }
  data.node_mass = VectorX::Constant(8, 10);
  const BodyExtent extent = body_extent(data);
  EXPECT_EQ(extent.size, Vector3(2, 1, 0.5));
  EXPECT_EQ(extent.mass, 80);
  EXPECT_LT((extent.centre - Vector3(2, 0.5, 0.25)).norm(), 1e-14);
  EXPECT_NEAR(extent.inertia(0, 0), 80 * (1 + 0.25) / 4, 1e-12);
  EXPECT_NEAR(extent.inertia(1, 1), 80 * (4 + 0.25) / 4, 1e-12);
  EXPECT_NEAR(extent.inertia(2, 2), 80 * (4 + 1) / 4, 1e-12);
  EXPECT_NEAR(extent.inertia(0, 1), 0, 1e-12);
}

TEST(BodyExtent, OfAMassMatrixIsThatOfItsNodes) {
  const ModalData data = measured_on(random_lumped(9, 3), {});
  const BodyExtent nodes = body_extent(data), matrix = body_extent(data, lumped_mass_matrix(data.node_mass));
  EXPECT_NEAR(matrix.mass, nodes.mass, 1e-12 * nodes.mass);
  EXPECT_LT((matrix.centre - nodes.centre).norm(), 1e-12);
  EXPECT_LT((matrix.inertia - nodes.inertia).norm(), 1e-11 * nodes.inertia.norm());
}

/// Everything of length times `factor`, as a wrong unit does.
ModalData in_unit(ModalData data, double factor) {
  data.node_position *= factor;
  return data;
}

std::string doubt_of(const ModalData& data) {
  const auto doubt = doubt_of_units(body_extent(data), data.omega[0]);
  return doubt ? doubt->text() : "";
}

TEST(DoubtOfUnits, MillimetresForMetresAreFoundByDensityAndWithoutMassesBySize) {
  for (const TestStructure& structure : {chassis(), slender_block(), l_shape()}) {
    ModalData data = measured_on(structure, {}, 10);
    EXPECT_EQ(doubt_of(data), "");
    EXPECT_THAT(doubt_of(in_unit(data, 1000)), HasSubstr("probably not in m but in mm"));
    EXPECT_THAT(doubt_of(in_unit(data, 1e-3)), HasSubstr("the mass does not suit the size"));
    data.node_mass.resize(0);
    EXPECT_EQ(doubt_of(data), "");
    EXPECT_THAT(doubt_of(in_unit(data, 1000)), HasSubstr("this is the size of a mountain"));
  }
}

TEST(DoubtOfUnits, WavesThatRunTooFastTellLengthsWithoutMasses) {
  BodyExtent extent;
  extent.size = {600, 40, 5};
  const auto doubt = doubt_of_units(extent, 2 * std::numbers::pi * 40);  // 2 L f = 48 km/s
  ASSERT_TRUE(doubt);
  EXPECT_THAT(doubt->what, HasSubstr("waves do not run so fast"));
  EXPECT_FALSE(doubt_of_units(extent, 2 * std::numbers::pi * 0.2));  // a bridge
}

TEST(DoubtOfUnits, ThinAndFlatBodiesAreNotDoubted) {
  const auto doubt = [](const Vector3& size, double mass) {
    BodyExtent extent;
    extent.size = size;
    extent.mass = mass;
    return doubt_of_units(extent, 100).has_value();
  };
  EXPECT_FALSE(doubt({2, 0, 0}, 0.5));  // a rod of 6 mm along its nodes
  EXPECT_FALSE(doubt({2, 0, 0}, 600));  // a steel girder, 0.2 m square
  EXPECT_FALSE(doubt({1, 1, 0}, 0.8));  // a sheet of 0.1 mm
  EXPECT_FALSE(doubt({1, 1, 0}, 780));  // a plate of 0.1 m
  EXPECT_FALSE(doubt({4.5, 1.8, 1.4}, 250));
  EXPECT_FALSE(doubt({0.1, 0.1, 0.1}, 19.3));  // tungsten
  EXPECT_TRUE(doubt({2000, 0, 0}, 600));
  EXPECT_TRUE(doubt({1000, 1000, 0}, 78));
  EXPECT_TRUE(doubt({4500, 1800, 1400}, 250));
}

TEST(DoubtOfUnits, IsAWarningOfAnIdentificationWhichTellsWhatItUnderstood) {
  IdentificationTask task = task_on(chassis(), chassis_springs(), 20);
  const Judgement clean = identify(task).judgement;
  EXPECT_THAT(clean.notes, Contains(HasSubstr("size 2.4 x 0.4 x 0.4 m; mass 998.4 kg")));
  task.measured.node_position *= 1000;
  const Judgement wrong = identify(task).judgement;
  EXPECT_THAT(wrong.notes, Contains(HasSubstr("size 2400 x 400 x 400 m")));
  EXPECT_THAT(wrong.warnings, Contains(HasSubstr("lengths are probably not in m but in mm")));
}

}  // namespace
}  // namespace wishbone
