#include "identification/formats/uff/uff_modal_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "identification/formats/uff/uff_reader.h"
#include "identification/formats/uff/uff_writer.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kTwoPi = 2 * std::numbers::pi;
const TextFiles kFiles;

std::string fixture_file(const std::string& name) {
  return std::string(WISHBONE_TEST_DATA) + "/uff/" + name;
}

ModalData data_of(const UffFile& file, UffShapeAxes axes = UffShapeAxes::kByDataset) {
  write_uff(kFiles / "file.unv", file);
  return read_uff_modal_data(kFiles / "file.unv", axes);
}

std::string refusal_of(const UffFile& file) {
  return message_of<InputError>([&] { data_of(file); });
}

std::string text_of(const std::vector<std::string>& provenance) {
  std::string text;
  for (const std::string& line : provenance) text += line + "\n";
  return text;
}

/// A real normal mode at nodes 1, 2, ... with three values each.
UffShape normal_mode(double hertz, const std::vector<double>& values) {
  UffShape shape;
  shape.frequency = hertz;
  shape.values = values;
  for (std::size_t i = 1; i <= values.size() / 3; ++i) shape.nodes.push_back(static_cast<int>(i));
  return shape;
}

UffFile two_nodes() {
  UffFile file;
  file.nodes = {{1, 0, 0, 0, {1, 2, 3}}, {2, 0, 0, 0, {4, 5, 6}}};
  return file;
}

UffFile two_nodes_with(std::vector<UffShape> shapes) {
  UffFile file = two_nodes();
  file.shapes = std::move(shapes);
  return file;
}

// ---- units
// --------------------------------------------------------------------------------------------------

/// Adds a mode to a file of another program, so that it becomes modal data.
ModalData with_mode(const std::string& name, double modal_mass) {
  UffFile file = read_uff(fixture_file(name));
  file.shapes = {normal_mode(1, {1, 2, 3})};
  file.shapes[0].modal_mass = modal_mass;
  return data_of(file);
}

TEST(UffModalData, AFactorOf1000PerMetreMeansMillimetres) {
  const ModalData data = with_mode("heat_engine_housing.uff", 5);
  EXPECT_NEAR((data.node_position.col(0) - Vector3(-0.1711755676, 0.1036403427, 0.1384829102)).norm(), 0,
              1e-10);
  EXPECT_NEAR(data.modal_mass[0], 5, 1e-12);  // mN / (mm/s2) = kg
  EXPECT_THAT(text_of(data.provenance),
              HasSubstr("dataset 164, code 5 (mm, mN), length 0.001 m, force 0.001 N"));
}

TEST(UffModalData, FactorsOfOneMeanMetres) {
  const ModalData data = with_mode("TestLab_161_164_18_15_82.uff", 5);
  EXPECT_NEAR((data.node_position.col(35) - Vector3(1.2, 8.4, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(data.lines.size(), 7u + 16u + 7u);
}

TEST(UffModalData, MassesFollowFromForceAndLength) {
  struct System {
    int code;
    double length, force, kilogram;
  };
  // 1 lbf s2/ft = 1 slug = 14.5939 kg; 1 kgf s2/m = 9.80665 kg; 1 N s2/mm = 1 t; 1 lbf s2/in = 175.127 kg;
  // pound
  const std::vector<System> systems = {{2, 3.280839895013123, 0.2248089430997105, 14.593902937206366},
                                       {3, 1, 0.1019716212977928, 9.80665},
                                       {4, 3.280839895013123, 7.233013851209894, 0.45359237},
                                       {7, 39.37007874015748, 0.2248089430997105, 175.12683524647638},
                                       {10, 1000, 1, 1000}};
  for (const System& system : systems) {
    UffFile file = two_nodes_with({normal_mode(1, {1, 2, 3, 4, 5, 6})});
    file.shapes[0].modal_mass = 1;
    file.units = {system.code, "", 1, system.length, system.force, 1, 0};
    const ModalData data = data_of(file);
    EXPECT_NEAR(data.modal_mass[0], system.kilogram, 1e-9 * system.kilogram) << system.code;
    EXPECT_NEAR(data.node_position(1, 0), 2 / system.length, 1e-12);
    EXPECT_THAT(text_of(data.provenance), Not(HasSubstr("the factors were used"))) << system.code;
  }
}

TEST(UffModalData, WithoutUnitsMetresAreAssumedAndThatIsSaid) {
  const ModalData data = data_of(two_nodes_with({normal_mode(1, {1, 2, 3, 4, 5, 6})}));
  EXPECT_EQ(data.node_position(2, 1), 6);
  EXPECT_THAT(text_of(data.provenance), HasSubstr("the file says none (no dataset 164), m and N assumed"));
}

TEST(UffModalData, FactorsGoBeforeACodeThatContradictsThem) {
  UffFile file = two_nodes_with({normal_mode(1, {1, 2, 3, 4, 5, 6})});
  file.units = {1, "SI units", 1, 3.28083989501312334, 0.2248089430997105, 1.8, 459.67};
  const ModalData data = data_of(file);
  EXPECT_NEAR(data.node_position(0, 0), 0.3048, 1e-9);
  EXPECT_THAT(text_of(data.provenance), HasSubstr("the code means 1 m and 1 N, the factors were used"));
}

// ---- axes
// ---------------------------------------------------------------------------------------------------

/// System 1: origin (10, 0, 0), turned by 90 deg about z: its x is global y. System 2: in 1, origin (0, 1,
/// 0), likewise.
UffFile with_turned_systems() {
  Matrix3 quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  UffFile file = two_nodes();
  file.coordinate_systems = {{1, 0, 0, 0, "one", {10, 0, 0}, quarter},
                             {2, 0, 1, 0, "two", {0, 1, 0}, quarter}};
  file.node_dataset = UffNodeDataset::k781;
  file.nodes[0].definition_system = 1;
  file.nodes[0].displacement_system = 1;
  file.nodes[1].definition_system = 2;
  file.nodes[1].displacement_system = 2;
  file.shapes = {normal_mode(1, {1, 2, 3, 4, 5, 6})};
  return file;
}

TEST(UffModalData, PositionsAndShapesAreTurnedIntoGlobalAxes) {
  const ModalData data = data_of(with_turned_systems());
  EXPECT_LT((data.node_position.col(0) - Vector3(10 - 2, 1, 3)).norm(), 1e-12);
  // (4, 5, 6) in 2: (-5, 4, 6) + (0, 1, 0) in 1: (-5, 5, 6) -> (-5, -5, 6) + (10, 0, 0)
  EXPECT_LT((data.node_position.col(1) - Vector3(5, -5, 6)).norm(), 1e-12);
  EXPECT_LT((data.shapes.col(0) - (VectorX(6) << -2, 1, 3, -4, -5, 6).finished()).norm(), 1e-12);
  EXPECT_THAT(text_of(data.provenance),
              HasSubstr("2 nodes have displacement coordinate systems: shapes were turned"));
}

/// Five nodes on a straight line, each with its own displacement system, and a mode in which the line translates along
/// (1, 2, 3) as each system sees it. Datasets 15 and 781 give positions in system 30, 2411 in the part's system.
UffFile straight_line(UffNodeDataset dataset) {
  UffFile file;
  file.node_dataset = dataset;
  const auto turned = [](double angle, const Vector3& axis) {
    return Matrix3(Eigen::AngleAxisd(angle, axis.normalized()));
  };
  file.coordinate_systems = {{30, 0, 0, 0, "definition", {1, -2, 0.5}, turned(0.7, {1, 1, 0})}};
  UffShape mode = normal_mode(5, {});
  for (int i = 0; i < 5; ++i) {
    const UffCoordinateSystem sensor{i + 1, 0, 0, 0, "sensor", {0, 0, 0}, turned(0.4 * i, {1, 1.0 * i, 2})};
    file.coordinate_systems.push_back(sensor);
    const Vector3 global(0.1 * i, 0.2 * i, -0.3 * i);
    const UffCoordinateSystem& definition = file.coordinate_systems[0];
    const bool in_part = dataset == UffNodeDataset::k2411;
    file.nodes.push_back({i + 1, in_part ? 0 : 30, i + 1, 0,
                          in_part ? global : definition.axes.transpose() * (global - definition.origin),
                          in_part ? 30 : 0});
    mode.nodes.push_back(i + 1);
    const Vector3 local = sensor.axes.transpose() * Vector3(1, 2, 3);
    mode.values.insert(mode.values.end(), local.data(), local.data() + 3);
  }
  file.shapes = {mode};
  return file;
}

TEST(UffModalData, PositionsFollowTheDefinitionSystemOrThePartAndShapesTheDisplacementSystem) {
  for (const UffNodeDataset dataset : {UffNodeDataset::k15, UffNodeDataset::k781, UffNodeDataset::k2411}) {
    const ModalData data = data_of(straight_line(dataset));
    ASSERT_EQ(data.freedom_count(), 15);
    for (int i = 0; i < 5; ++i) {
      EXPECT_LT((data.node_position.col(i) - i * Vector3(0.1, 0.2, -0.3)).norm(), 2e-5) << i;
      EXPECT_LT((data.shapes.col(0).segment<3>(3 * i) - Vector3(1, 2, 3)).norm(), 5e-5) << i;
    }
    EXPECT_THAT(
        text_of(data.provenance),
        HasSubstr(dataset == UffNodeDataset::k2411 ? "5 nodes have export coordinate systems (dataset 2411)"
                                                   : "5 nodes have definition coordinate systems"));
  }
}

TEST(UffModalData, DoublePrecisionNodesOfDataset2411AreNotWrittenInDefinitionSystems) {
  UffFile file = straight_line(UffNodeDataset::k781);
  file.node_dataset = UffNodeDataset::k2411;
  EXPECT_THAT(refusal_of(file), HasSubstr("positions in the part's system only"));
}

TEST(UffModalData, CurvedCoordinatesBecomeGlobalOnes) {
  constexpr double kRoot = std::numbers::sqrt2 / 2;
  UffFile file;
  file.node_dataset = UffNodeDataset::k781;
  file.coordinate_systems = {{4, 1, 0, 0, "cylindrical", {1, 0, 0}, Matrix3::Identity()},
                             {5, 2, 0, 0, "spherical", {0, 1, 0}, Matrix3::Identity()}};
  // (r, theta, z) = (2, 90 deg, 3); on the axis, where theta tells nothing; (r, theta, phi) = (2, 45 deg, 90 deg)
  file.nodes = {{1, 4, 4, 0, {2, 90, 3}}, {2, 4, 4, 0, {0, 0, 7}}, {3, 5, 5, 0, {2, 45, 90}}};
  file.shapes = {normal_mode(1, {10, 20, 30, 10, 20, 30, 10, 20, 30})};
  const ModalData data = data_of(file);
  EXPECT_LT((data.node_position.col(0) - Vector3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((data.node_position.col(1) - Vector3(1, 0, 7)).norm(), 1e-12);
  EXPECT_LT((data.node_position.col(2) - Vector3(0, 1 + 2 * kRoot, 2 * kRoot)).norm(), 1e-12);
  EXPECT_LT((data.shapes.col(0).segment<3>(0) - Vector3(-20, 10, 30)).norm(), 1e-12);
  EXPECT_LT((data.shapes.col(0).segment<3>(3) - Vector3(10, 20, 30)).norm(), 1e-12);
  // e_r = (0, 1, 1)/sqrt(2), e_theta = (0, 1, -1)/sqrt(2), e_phi = (-1, 0, 0)
  EXPECT_LT((data.shapes.col(0).segment<3>(6) - Vector3(-30, 30 * kRoot, -10 * kRoot)).norm(), 1e-12);
  EXPECT_THAT(text_of(data.provenance), HasSubstr("angles in degrees"));
}

TEST(UffModalData, ANodeListedInTwoSystemsMustBeInOnePlace) {
  const auto listed_twice = [](const Vector3& in_system) {
    std::string text = "    -1\n    18\n         3         0         0         0         1\nSYS\n";
    text += "  1.00000E+00  0.00000E+00  0.00000E+00  2.00000E+00  0.00000E+00  0.00000E+00\n";
    text += "  1.00000E+00  0.00000E+00  1.00000E+00\n    -1\n    -1\n    15\n";
    text += fmt::format("{:10}{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}\n    -1\n", 1, 3, 0, 0, in_system.x(),
                        in_system.y(), in_system.z());
    text += fmt::format("    -1\n  2411\n{:10}{:10}{:10}{:10}\n{:25.16E}{:25.16E}{:25.16E}\n    -1\n", 1, 0,
                        0, 0, 3.0, 4.0, 5.0);
    UffFile file;
    file.shapes = {normal_mode(1, {1, 2, 3})};
    write_uff(kFiles / "mode.unv", file);
    std::ifstream mode(kFiles / "mode.unv");
    text.append(std::istreambuf_iterator<char>(mode), {});
    std::ofstream(kFiles / "twice.unv") << text;
    return read_uff_modal_data(kFiles / "twice.unv");
  };
  EXPECT_LT((listed_twice({2, 4, 5}).node_position.col(0) - Vector3(3, 4, 5)).norm(), 1e-12);
  EXPECT_THAT(message_of<InputError>([&] { listed_twice({3, 4, 5}); }), HasSubstr("a node is defined twice"));
}

TEST(UffModalData, ShapesOfDataset2414AreGlobalUnlessOneSaysOtherwise) {
  UffFile file = with_turned_systems();
  file.shapes[0].dataset = 2414;
  EXPECT_EQ(data_of(file).shapes.col(0), (VectorX(6) << 1, 2, 3, 4, 5, 6).finished());
  EXPECT_EQ(data_of(file, UffShapeAxes::kDisplacementSystems).shapes(0, 0), -2);
  file.shapes[0].dataset = 55;
  EXPECT_EQ(data_of(file, UffShapeAxes::kGlobal).shapes(0, 0), 1);
  EXPECT_THAT(text_of(data_of(file, UffShapeAxes::kGlobal).provenance),
              HasSubstr("shapes were taken as global"));
  file.shapes.push_back(file.shapes[0]);
  file.shapes[1].dataset = 2414;
  file.shapes[1].frequency = 2;
  EXPECT_THAT(refusal_of(file), HasSubstr("modes of datasets 55 and 2414 refer to different axes"));
}

TEST(UffModalData, AMeasuredDirectionOfALocalSystemBecomesItsGlobalAxis) {
  UffFile file = with_turned_systems();
  file.shapes = {normal_mode(1, {7, 0, 0, 0, 0, 6})};
  const ModalData data = data_of(file);
  EXPECT_THAT(data.freedoms, ElementsAre(Freedom{1, 1}, Freedom{2, 2}));
  EXPECT_THAT(data.shapes.reshaped(), ElementsAre(7, 6));
}

TEST(UffModalData, SystemsThatCannotBeFollowedAreRefused) {
  UffFile file = with_turned_systems();
  file.nodes[0].definition_system = 5;
  EXPECT_THAT(refusal_of(file), HasSubstr("referred to and not defined (got coordinate system 5)"));
  file = with_turned_systems();
  file.coordinate_systems[0].reference = 2;
  EXPECT_THAT(refusal_of(file), HasSubstr("in a circle"));
  file = with_turned_systems();
  file.coordinate_systems[0].type = 1;  // which system 2 refers to
  EXPECT_THAT(refusal_of(file), HasSubstr("refers to one that is not Cartesian (got coordinate system 2)"));
  file = with_turned_systems();
  file.coordinate_systems[1].type = 3;
  EXPECT_THAT(refusal_of(file), HasSubstr("of type 3, which there is none of"));
  file = with_turned_systems();
  file.coordinate_systems.clear();
  for (UffNode& node : file.nodes) node.definition_system = node.displacement_system = 1;
  EXPECT_EQ(data_of(file).node_position.col(0), Vector3(1, 2, 3));  // 1 is global where it is not defined
}

// ---- modes
// --------------------------------------------------------------------------------------------------

TEST(UffModalData, ModesOfAFiniteElementProgramAreRead) {
  const ModalData data = read_uff_modal_data(fixture_file("2411_and_2414.uff"));
  EXPECT_EQ(data.title, "tulay_01.unvo");
  EXPECT_EQ(data.node_count(), 441);
  ASSERT_EQ(data.mode_count(), 10);
  EXPECT_NEAR(data.omega[0], kTwoPi * 0.956363, 1e-12);
  EXPECT_NEAR(data.omega[9], kTwoPi * 25.7643, 1e-12);
  EXPECT_TRUE(data.modal_mass.array().isNaN().all());
  EXPECT_EQ(data.shapes(*data.row({1, 2}), 0), -7.08571e-1);
  EXPECT_EQ(data.row({441, 0}), std::nullopt);  // zero in every mode
  EXPECT_EQ(data.lines.size(), 840u);           // a grid of 20 x 20 squares has 2 * 20 * 21 edges
  EXPECT_THAT(text_of(data.provenance), AllOf(HasSubstr("left out the rotations"), HasSubstr("Permas")));
}

TEST(UffModalData, NormalModesComeInAscendingOrderWithDampingAndMass) {
  UffShape first = normal_mode(20, {1, 2, 3, 4, 5, 6}), second = normal_mode(10, {6, 5, 4, 3, 2, 1});
  first.viscous_damping = 0.02;
  first.hysteretic_damping = 0.5;
  first.modal_mass = 3;
  second.hysteretic_damping = 0.06;  // loss factor 2 zeta
  const ModalData data = data_of(two_nodes_with({first, second, normal_mode(0, {1, 0, 0, 1, 0, 0})}));
  ASSERT_EQ(data.mode_count(), 2);
  EXPECT_NEAR(data.omega[0], kTwoPi * 10, 1e-12);
  EXPECT_EQ(data.damping_ratio, Eigen::Vector2d(0.03, 0.02));
  EXPECT_TRUE(std::isnan(data.modal_mass[0]));
  EXPECT_EQ(data.modal_mass[1], 3);
  EXPECT_THAT(data.shapes.col(1), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_TRUE(data.is_complete());
  EXPECT_THAT(text_of(data.provenance), HasSubstr("left out 1 modes of zero frequency"));
}

UffShape complex_mode(std::complex<double> s, const std::vector<double>& real, std::complex<double> factor,
                      int analysis = kUffComplexModeFirstOrder) {
  UffShape shape = normal_mode(0, real);
  shape.analysis = analysis;
  shape.is_complex = true;
  shape.eigenvalue = s;
  shape.values.clear();
  for (const double x : real) {
    shape.values.push_back((factor * x).real());
    shape.values.push_back((factor * x).imag());
  }
  return shape;
}

TEST(UffModalData, ComplexModesBecomeReal) {
  const std::vector<double> real = {1, -2, 3, 4, 5, -6};
  for (const int analysis : {3, 7}) {
    const UffShape mode = complex_mode({-5, 99}, real, std::polar(2.0, 0.7), analysis);
    const UffShape conjugate = complex_mode({-5, -99}, real, std::polar(2.0, -0.7), analysis);
    const UffShape overdamped = complex_mode({-5, 0}, real, 1, analysis);
    const ModalData data = data_of(two_nodes_with({mode, conjugate, overdamped}));
    ASSERT_EQ(data.mode_count(), 1);
    EXPECT_NEAR(data.omega[0], std::hypot(5, 99), 1e-12);
    EXPECT_NEAR(data.damping_ratio[0], 5 / std::hypot(5, 99), 1e-12);
    EXPECT_TRUE(std::isnan(data.modal_mass[0]));
    const VectorX expected = -2 * Eigen::Map<const VectorX>(real.data(), 6);  // largest component positive
    EXPECT_LT((data.shapes.col(0) - expected).norm(), 1e-4);
    EXPECT_THAT(text_of(data.provenance),
                AllOf(HasSubstr("left out 2 complex modes"), Not(HasSubstr("is complex"))));
  }
}

TEST(UffModalData, ComplexValuesWithoutImaginaryPartsStayAsTheyAre) {
  UffShape mode = complex_mode(0, {1, -2, 3, 4, 5, -6}, 1, kUffNormalMode);
  mode.frequency = 5;
  EXPECT_THAT(data_of(two_nodes_with({mode})).shapes.col(0), ElementsAre(1, -2, 3, 4, 5, -6));
}

TEST(UffModalData, ModesThatAreFarFromRealAreNamed) {
  UffShape mode = complex_mode({-5, 99}, {1, 2, 3, 4, 5, 6}, 1);
  for (std::size_t k = 1; k < 6; k += 2) mode.values[k] = 3;  // imaginary parts of node 1
  const std::string text = text_of(data_of(two_nodes_with({mode})).provenance);
  EXPECT_THAT(
      text, AllOf(HasSubstr("mode 1 at 15.7"), HasSubstr("phase collinearity"), HasSubstr("imaginary part")));
}

TEST(UffModalData, DatasetsOfOneModeAtOtherNodesArePutTogether) {
  UffShape left = normal_mode(10, {1, 2, 3}), right = left;
  right.nodes = {2};
  right.values = {4, 5, 6};
  const ModalData data = data_of(two_nodes_with({left, right}));
  EXPECT_EQ(data.mode_count(), 1);
  EXPECT_THAT(data.shapes.col(0), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(UffModalData, ARepeatedDatasetCountsOnceAndARepeatedFrequencyTwice) {
  const UffShape mode = normal_mode(10, {1, 2, 3, 4, 5, 6}), other = normal_mode(10, {3, 2, 1, 6, 5, 4});
  const ModalData data = data_of(two_nodes_with({mode, mode, other}));
  EXPECT_EQ(data.mode_count(), 2);
  EXPECT_THAT(text_of(data.provenance), HasSubstr("left out 1 datasets that repeat another one"));
}

TEST(UffModalData, FreedomsAreThoseThatMoveAtNodesThatAllModesKnow) {
  UffFile file = two_nodes_with({normal_mode(10, {0, 2, 0, 4, 0, 0}), normal_mode(20, {0, 0, 0, 1, 0, 0}),
                                 normal_mode(30, {0, 1, 0, 0, 1, 0, 1, 2, 3})});
  file.nodes.push_back({3, 0, 0, 0, {7, 8, 9}});
  const ModalData data = data_of(file);
  EXPECT_EQ(data.node_count(), 3);
  EXPECT_THAT(data.freedoms, ElementsAre(Freedom{1, 1}, Freedom{2, 0}, Freedom{2, 1}));
  EXPECT_THAT(text_of(data.provenance), AllOf(HasSubstr("left out 1 nodes that some modes do not know"),
                                              HasSubstr("3 freedoms are zero in every mode")));
}

TEST(UffModalData, DisplacementsGoBeforeOtherResults) {
  UffShape displacement = normal_mode(10, {1, 2, 3, 4, 5, 6}), acceleration = displacement,
           force = displacement;
  acceleration.quantity = 12;
  acceleration.modal_mass = 2;
  force.quantity = 9;
  EXPECT_EQ(data_of(two_nodes_with({acceleration, force, displacement})).mode_count(), 1);
  const ModalData alone = data_of(two_nodes_with({acceleration, force}));
  EXPECT_EQ(alone.mode_count(), 1);
  EXPECT_TRUE(std::isnan(alone.modal_mass[0]));  // refers to displacements
}

TEST(UffModalData, AFileWithoutModesOrPositionsIsRefusedWithWhatItHolds) {
  const auto refusal = [](const std::string& name) {
    return message_of<InputError>([&] { read_uff_modal_data(fixture_file(name)); });
  };
  EXPECT_THAT(refusal("heat_engine_housing.uff"),
              AllOf(HasSubstr("the file holds no modes"), HasSubstr("10 nodes, 8 elements, 1 nodal result"),
                    HasSubstr("analysis type 1 is no mode")));
  EXPECT_THAT(refusal("uff55_translation.uff"),
              AllOf(HasSubstr("4 nodes of the mode shapes have no position"), HasSubstr("3 nodal results")));
  EXPECT_THAT(refusal("1858.uff"), HasSubstr("2 datasets that are not read"));
  EXPECT_THAT(refusal("Sample_UFF58b_bin.uff"), HasSubstr("1 function"));
  EXPECT_THAT(refusal_of(two_nodes_with({normal_mode(0, {1, 2, 3, 4, 5, 6})})),
              HasSubstr("of zero frequency"));
}

// ---- there and back
// -----------------------------------------------------------------------------------------

TEST(UffModalData, RoundTripKeepsSixDigits) {
  ModalData data;
  data.title = "a frame, m\u00B2";
  data.node_ids = {4, 2, 9, 7};
  data.node_position = Matrix3X::Random(3, 4);
  data.freedoms = {{4, 0}, {4, 2}, {2, 0}, {2, 1}, {2, 2}, {9, 1}};
  data.omega = Vector3(10.123456789, 200.5, 3e5);
  data.damping_ratio = Vector3(0.0123456789, 0, 0.3);
  data.modal_mass = Vector3(1, std::nan(""), 1.0 / 3);
  data.shapes = MatrixX::Random(6, 3);
  data.lines = {{4, 2}, {2, 9}, {7, 4}};
  write_uff_modal_data(kFiles / "there.unv", data);
  const ModalData back = read_uff_modal_data(kFiles / "there.unv");

  EXPECT_EQ(back.title, data.title);
  EXPECT_EQ(back.node_ids, data.node_ids);
  EXPECT_EQ(back.node_position, data.node_position);
  EXPECT_EQ(back.freedoms, data.freedoms);
  EXPECT_EQ(back.lines, data.lines);
  constexpr double kSixDigits = 5.001e-6;
  EXPECT_TRUE(((back.omega - data.omega).array().abs() <= kSixDigits * data.omega.array()).all());
  EXPECT_TRUE(
      ((back.damping_ratio - data.damping_ratio).array().abs() <= kSixDigits * data.damping_ratio.array())
          .all());
  EXPECT_TRUE(((back.shapes - data.shapes).array().abs() <= kSixDigits * data.shapes.array().abs()).all());
  EXPECT_EQ(back.modal_mass[0], 1);
  EXPECT_TRUE(std::isnan(back.modal_mass[1]));
  EXPECT_NEAR(back.modal_mass[2], 1.0 / 3, kSixDigits / 3);
}

TEST(UffModalData, InvalidDataIsNotWritten) {
  ModalData data;
  data.omega = Vector3(1, 2, 3);
  EXPECT_THROW(write_uff_modal_data(kFiles / "never.unv", data), InputError);
  EXPECT_FALSE(std::filesystem::exists(kFiles / "never.unv"));
}

}  // namespace
}  // namespace wishbone
