#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "identification/formats/uff/uff_elements.h"
#include "identification/formats/uff/uff_reader.h"

/// Files of other programs, checked against what their text says.
namespace wishbone {
namespace {

using testing::ElementsAre;

UffFile fixture(const std::string& name) {
  return read_uff(std::filesystem::path(WISHBONE_TEST_DATA) / "uff" / name);
}

TEST(UffFixtures, DatasetsOfUnknownKindAreNamedWithTheirPlace) {
  const UffFile file = fixture("1858.uff");
  ASSERT_EQ(file.unused.size(), 2u);
  EXPECT_EQ(file.unused[0].dataset, 1858);
  EXPECT_EQ(file.unused[0].line, 2u);
  EXPECT_EQ(file.unused[1].line, 12u);
  EXPECT_FALSE(file.unused[0].why.empty());
}

TEST(UffFixtures, FiniteElementProgramWritesShellsAndModesOfSixValuesPerNode) {
  const UffFile file = fixture("2411_and_2414.uff");
  ASSERT_TRUE(file.header);
  EXPECT_EQ(file.header->model, "tulay_01.unvo");
  EXPECT_EQ(file.header->program, "Permas Version 18.00.405     on Linux-x86_64-3.1");
  ASSERT_EQ(file.nodes.size(), 441u);
  EXPECT_EQ(file.nodes[1].position, Vector3(0.95, 0, 0));
  ASSERT_EQ(file.elements.size(), 400u);
  EXPECT_EQ(file.elements[399].descriptor, 94);
  EXPECT_THAT(file.elements[399].nodes, ElementsAre(419, 420, 441, 440));
  ASSERT_EQ(file.shapes.size(), 10u);
  const UffShape& first = file.shapes[0];
  EXPECT_EQ(first.dataset, 2414);
  EXPECT_EQ(first.ids[4], "Mode shapes                             Column 1");
  EXPECT_EQ(first.analysis, kUffNormalMode);
  EXPECT_EQ(first.values_per_node, 6);
  EXPECT_EQ(first.number, 1);
  EXPECT_EQ(first.frequency, 9.56363e-1);
  ASSERT_EQ(first.nodes.size(), 441u);
  ASSERT_EQ(first.values.size(), 6 * 441u);
  EXPECT_EQ(first.values[2], -7.08571e-1);
  EXPECT_EQ(file.shapes[9].number, 10);
  EXPECT_EQ(file.shapes[9].frequency, 2.57643e1);
  EXPECT_EQ(file.shapes[9].values[6 * 439 + 4], 2.69448e-1);
  EXPECT_TRUE(file.unused.empty());
}

TEST(UffFixtures, TextAndBinaryOfOneRecordAreTheSame) {
  const UffFile text_file = fixture("Sample_UFF58_ascii.uff"), binary_file = fixture("Sample_UFF58b_bin.uff");
  ASSERT_EQ(text_file.functions.size(), 1u);
  ASSERT_EQ(binary_file.functions.size(), 1u);
  const UffFunction &text = text_file.functions[0], &binary = binary_file.functions[0];
  EXPECT_FALSE(text.is_binary);
  EXPECT_TRUE(binary.is_binary);
  for (const UffFunction* f : {&text, &binary}) {
    EXPECT_EQ(f->ids[0], "Mic 01.0Scalar");
    EXPECT_EQ(f->type, 1);
    EXPECT_EQ(f->response.entity, "Mic 01");
    EXPECT_EQ(f->response.node, 0);
    EXPECT_EQ(f->response.direction, 1);
    EXPECT_EQ(f->reference.entity, "NONE");
    EXPECT_TRUE(f->is_even);
    EXPECT_FALSE(f->is_complex);
    EXPECT_EQ(f->abscissa_step, 1.52588e-5);
    EXPECT_EQ(f->ordinate_axis.quantity, 21);
    EXPECT_EQ(f->ordinate_axis.label, "Pressure");
    EXPECT_EQ(f->ordinate_axis.unit, "Pa");
    EXPECT_FALSE(f->is_double());
    ASSERT_EQ(f->point_count(), 79292u);
  }
  const auto& a = std::get<std::vector<float>>(text.values);
  const auto& b = std::get<std::vector<float>>(binary.values);
  EXPECT_EQ(a[0], -1.47553e-2f);
  EXPECT_EQ(a[79291], -4.31469e-3f);
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    worst = std::max(worst, std::abs(double{a[k]} - double{b[k]}) / std::abs(double{b[k]}));
  EXPECT_LT(worst, 5.1e-6);  // half a unit of the sixth digit
}

TEST(UffFixtures, TestGeometryHasLocalSystemsAndTraceLines) {
  const UffFile file = fixture("TestLab_161_164_18_15_82.uff");
  EXPECT_EQ(file.header->model, "AME_Test");
  EXPECT_EQ(file.units->code, 9);
  EXPECT_EQ(file.units->description, "USER_DEFINED");
  EXPECT_EQ(file.units->length, 1);
  EXPECT_EQ(file.units->temperature_offset, -273.14999999999996);
  ASSERT_EQ(file.coordinate_systems.size(), 36u);
  const UffCoordinateSystem& first = file.coordinate_systems[0];
  EXPECT_EQ(first.name, "SYS1");
  EXPECT_EQ(first.origin, Vector3(-2.4, -0.95, 0));
  // x towards (-3.4, -0.95, 0), z in the plane of that and (-3.4, -0.95, -1)
  EXPECT_TRUE(first.axes.isApprox(Vector3(-1, 1, -1).asDiagonal().toDenseMatrix(), 1e-6)) << first.axes;
  ASSERT_EQ(file.nodes.size(), 36u);
  EXPECT_EQ(file.nodes[35].number, 36);
  EXPECT_EQ(file.nodes[35].displacement_system, 36);
  EXPECT_EQ(file.nodes[35].position, Vector3(1.2, 8.4, 0));
  ASSERT_EQ(file.trace_lines.size(), 3u);
  EXPECT_EQ(file.trace_lines[0].name, "Massif");
  EXPECT_THAT(file.trace_lines[0].nodes, ElementsAre(2, 5, 6, 3, 4, 1, 2, 3, 0));
  EXPECT_EQ(file.trace_lines[1].nodes.size(), 32u);
  EXPECT_EQ(file.trace_lines[2].nodes.back(), 0);
}

TEST(UffFixtures, BinaryValuesMayBeInDoublePrecision) {
  const UffFile file = fixture("binary8byte.uff");
  ASSERT_EQ(file.functions.size(), 1u);
  const UffFunction& f = file.functions[0];
  EXPECT_EQ(f.response.entity, "sine 5 Hz");
  EXPECT_EQ(f.abscissa_step, 0.01);
  EXPECT_EQ(f.ordinate_axis.unit, "g");
  const auto& values = std::get<std::vector<double>>(f.values);
  ASSERT_EQ(values.size(), 250u);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double phase = 2 * M_PI * 5 * 0.01 * static_cast<double>(k);
    constexpr double kSingle = std::numeric_limits<float>::epsilon();  // the generator kept the phase so
    EXPECT_NEAR(values[k], std::sin(phase), kSingle * (1 + phase)) << k;
  }
}

TEST(UffFixtures, HousingHasMillimetresSolidsAndTemperatures) {
  const UffFile file = fixture("heat_engine_housing.uff");
  EXPECT_EQ(file.header->model, "");
  EXPECT_EQ(file.header->program, "VKI 453 24-Feb-23 22:10:15");
  EXPECT_EQ(file.units->code, 5);
  EXPECT_EQ(file.units->temperature_mode, 2);
  EXPECT_EQ(file.units->length, 1000);
  EXPECT_EQ(file.units->force, 1000);
  EXPECT_EQ(file.units->temperature_offset, 273.15);
  ASSERT_EQ(file.nodes.size(), 10u);
  EXPECT_EQ(file.nodes[9].position, Vector3(-147.6755676269531, 101.9969635009766, 147.4829101562500));
  ASSERT_EQ(file.elements.size(), 8u);
  EXPECT_EQ(uff_element_edges(file.elements[0]).size(), 6u);  // a tetrahedron
  EXPECT_EQ(uff_element_edges(file.elements[7]).size(), 3u);  // a triangle
  ASSERT_EQ(file.shapes.size(), 1u);
  EXPECT_EQ(file.shapes[0].quantity, 5);
  EXPECT_EQ(file.shapes[0].values_per_node, 1);
  EXPECT_EQ(file.shapes[0].values[8], 24.9963);
}

TEST(UffFixtures, MeshOfATestHasNodesInADefinedSystem) {
  const UffFile file = fixture("mesh_Oros-modal_uff15_uff2412.uff");
  ASSERT_EQ(file.coordinate_systems.size(), 1u);
  EXPECT_TRUE(file.coordinate_systems[0].axes.isIdentity());
  ASSERT_EQ(file.nodes.size(), 96u);
  EXPECT_EQ(file.nodes[0].number, 7);
  EXPECT_EQ(file.nodes[3].position, Vector3(5.09760e-15, 83.25, 50));
  EXPECT_EQ(file.nodes[0].definition_system, 1);
  ASSERT_EQ(file.elements.size(), 72u);
  EXPECT_THAT(file.elements[0].nodes, ElementsAre(1, 25, 48, 24));
}

TEST(UffFixtures, TextsKeepTheirBytes) {
  const UffFile file = fixture("non_ascii_header.uff");
  const UffFunction& f = file.functions.at(0);
  EXPECT_EQ(f.type, 4);
  EXPECT_EQ(f.denominator_axis.unit, "NONE");
  EXPECT_EQ(f.ordinate_axis.unit, "(1/N)*(m/s\xB2)");
  EXPECT_TRUE(f.is_complex);
  ASSERT_EQ(f.point_count(), 6u);
  EXPECT_THAT(std::get<std::vector<float>>(f.values),
              ElementsAre(4.07994e-1f, 0, -5.99924e-2f, -5.53260e-2f, 2.58750e-2f, -2.30085e-4f, -2.99003e-1f,
                          3.17213e-1f, -1.80250f, 1.55302f, 3.75037f, 2.93363f));
}

TEST(UffFixtures, RowsNeedNotBeFull) {
  const UffFile file = fixture("time-history-not-all-columns-filled.uff");
  const UffFunction& f = file.functions.at(0);
  EXPECT_EQ(f.ids[1], "UFF58 file created by HBM catman");
  EXPECT_EQ(f.abscissa_step, 5e-5);
  ASSERT_EQ(f.point_count(), 13u);
  EXPECT_EQ(std::get<std::vector<float>>(f.values)[12], -5.84096f);
}

TEST(UffFixtures, ModesMayComeWithoutNodes) {
  const UffFile file = fixture("uff55_translation.uff");
  ASSERT_EQ(file.shapes.size(), 3u);
  EXPECT_TRUE(file.nodes.empty());
  EXPECT_EQ(file.shapes[1].frequency, 12);
  EXPECT_EQ(file.shapes[1].number, 2);
  EXPECT_THAT(file.shapes[2].nodes, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(file.shapes[2].values,
              ElementsAre(-0.63467, -0.63467, -0.63467, -0.662803, -0.662803, -0.662803, 1.48845, 1.48845,
                          1.48845, -0.795555, -0.795555, -0.795555));
}

}  // namespace
}  // namespace wishbone
