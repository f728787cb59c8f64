#include "identification/judgement/sensor_faults.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "core/error.h"
#include "identification/identify.h"
#include "identification/measured.h"

// Faults that happen to modal tests are put into the modes of known structures on springs; each must be named, and
// clean data must not be doubted.
namespace wishbone {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180;

/// Gaussian scatter of every component, relative to the root mean square of its shape.
ModalData with_noise(ModalData data, double scatter, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (auto psi : data.shapes.colwise()) {
    const double size = scatter * psi.norm() / std::sqrt(static_cast<double>(psi.size()));
    for (double& x : psi) x += size * normal(random);
  }
  return data;
}

ModalData test_of(const TestStructure& structure, double scatter = 0.01, unsigned seed = 1) {
  std::vector<int> ends = {structure.node_ids.front(), structure.node_ids[1],
                           structure.node_ids[structure.node_ids.size() - 2], structure.node_ids.back()};
  const double stiffness = 2e-3 * structure.elastic().lambda[0] * structure.node_mass.sum() / 4;
  return with_noise(measured_on(structure, springs_at(ends, stiffness), 14), scatter, seed);
}

/// The rows of a node, 3 x modes.
auto rows_of(ModalData& data, int node) {
  return data.shapes.middleRows(*data.row({node, 0}), 3);
}

std::string only_fault(const ModalData& data, const std::vector<int>& nodes) {
  const std::vector<SensorFault> faults = find_sensor_faults(data);
  if (faults.size() != 1) {
    std::string all = std::to_string(faults.size()) + " faults:";
    for (const SensorFault& fault : faults)
      all += " [" + std::to_string(fault.nodes.front()) + "] " + fault.what;
    return all;
  }
  EXPECT_EQ(faults[0].nodes, nodes);
  return faults[0].what;
}

const std::vector<TestStructure>& structures() {
  static const std::vector<TestStructure> all = {chassis(), slender_block(), l_shape(), random_lumped(12, 5)};
  return all;
}

TEST(SensorFaults, CleanDataAreNotDoubted) {
  for (const TestStructure& structure : structures())
    for (const double scatter : {0.0, 0.01, 0.03})
      for (unsigned seed = 1; seed <= 3; ++seed)
        EXPECT_THAT(doubts_of_sensors(test_of(structure, scatter, seed)), IsEmpty());
}

TEST(SensorFaults, StiffSupportsAreNoFaults) {
  for (const double stiffness : {1e4, 1e5, 1e6, 1e7, 1e8})
    EXPECT_THAT(doubts_of_sensors(measured_on(chassis(), springs_at({1, 2, 17, 18}, stiffness), 20)),
                IsEmpty())
        << stiffness;
  EXPECT_THAT(doubts_of_sensors(measured_on(chassis(), chassis_joints(), 20)), IsEmpty());
  EXPECT_THAT(doubts_of_sensors(measured_on(chassis(), {}, 20)), IsEmpty());
}

TEST(SensorFaults, AFlippedChannelIsNamed) {
  for (const TestStructure& structure : structures())
    for (int axis = 0; axis < 3; ++axis) {
      ModalData data = test_of(structure);
      const int node = structure.node_ids[5];
      data.shapes.row(*data.row({node, axis})) *= -1;
      EXPECT_EQ(only_fault(data, {node}), fmt::format("the sign of {} is flipped", "xyz"[axis]));
    }
}

TEST(SensorFaults, SwappedAxesAreNamed) {
  for (const TestStructure& structure : structures()) {
    ModalData data = test_of(structure);
    const int node = structure.node_ids[6];
    auto rows = rows_of(data, node);
    rows = MatrixX(rows(std::vector<int>{1, 0, 2}, Eigen::all));
    EXPECT_EQ(only_fault(data, {node}), "axes are swapped: x, y, z show what should be y, x, z");
  }
}

TEST(SensorFaults, ATurnedSensorIsNamedWithItsAngle) {
  for (const TestStructure& structure : structures())
    for (const int angle : {20, 30, 50}) {
      ModalData data = test_of(structure);
      const int node = structure.node_ids[4];
      auto rows = rows_of(data, node);
      const Matrix3 R(Eigen::AngleAxisd(angle * kDegree, Vector3::UnitZ()));
      rows = MatrixX(R.transpose() * rows);
      const std::string what = only_fault(data, {node});
      const auto about = [](int degrees) {
        return HasSubstr("the sensor is turned by about " + std::to_string(degrees) + " deg about (");
      };
      EXPECT_THAT(what, AnyOf(about(angle - 1), about(angle), about(angle + 1)));
    }
}

double scale_in(const std::string& what) {
  double scale = 0;
  return std::sscanf(what.c_str(), "the scale is about %lf times", &scale) == 1 ? scale : 0;
}

TEST(SensorFaults, ASetupOfAnotherScaleIsNamedWithItsNodes) {
  for (const TestStructure& structure : structures())
    for (const double factor : {1.5, 0.6}) {
      ModalData data = test_of(structure);
      const auto count = structure.node_ids.size() * 2 / 5;
      const std::vector<int> nodes(structure.node_ids.end() - static_cast<std::ptrdiff_t>(count),
                                   structure.node_ids.end());
      for (const int node : nodes) rows_of(data, node) *= factor;
      EXPECT_NEAR(scale_in(only_fault(data, nodes)), factor, 0.02 * factor);
    }
}

TEST(SensorFaults, HalvesOfDifferentScaleAreToldApart) {
  ModalData data = test_of(chassis());
  for (int node = 11; node <= 20; ++node) rows_of(data, node) *= 1.5;
  const std::vector<SensorFault> faults = find_sensor_faults(data);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].nodes.size(), 10u);
  const double scale = scale_in(faults[0].what);
  EXPECT_NEAR(scale > 1 ? scale : 1 / scale, 1.5, 0.03);
}

TEST(SensorFaults, FaultsOfSeveralNodesAreNamedEach) {
  ModalData data = test_of(chassis());
  data.shapes.row(*data.row({3, 2})) *= -1;
  auto rows = rows_of(data, 9);
  rows = MatrixX(rows(std::vector<int>{0, 2, 1}, Eigen::all));
  rows_of(data, 14) *= 2;
  std::vector<int> nodes;
  for (const SensorFault& fault : find_sensor_faults(data))
    nodes.insert(nodes.end(), fault.nodes.begin(), fault.nodes.end());
  EXPECT_THAT(nodes, ElementsAre(3, 9, 14));
}

TEST(SensorFaults, SensorsOfOneAxisCanBeFlippedToo) {
  ModalData data = test_of(chassis());
  std::vector<int> rows;
  std::vector<Freedom> freedoms;
  for (int k = 0; k < data.freedom_count(); ++k)
    if (k % 3 == 2) {
      rows.push_back(k);
      freedoms.push_back(data.freedoms[static_cast<std::size_t>(k)]);
    }
  data.shapes = MatrixX(data.shapes(rows, Eigen::all));
  data.freedoms = freedoms;
  EXPECT_THAT(find_sensor_faults(data), IsEmpty());
  data.shapes.row(7) *= -1;
  EXPECT_EQ(only_fault(data, {8}), "the sign of z is flipped");
}

TEST(SensorFaults, AreWarningsOfAnIdentificationOrTheRemedyWhereItFails) {
  IdentificationTask task = task_on(chassis(), chassis_springs(), 20);
  EXPECT_THAT(identify(task).judgement.warnings, IsEmpty());
  task.measured.shapes.row(*task.measured.row({7, 2})) *= -1;
  std::vector<std::string> told;
  try {
    told = identify(task).judgement.warnings;
  } catch (const InputError& error) {
    told = {error.what()};
  }
  EXPECT_THAT(told, Contains(HasSubstr("node 7: the sign of z is flipped")));
}

TEST(MassProducts, AreToldWithTheirModes) {
  IdentificationTask task = task_on(chassis(), chassis_springs(), 20);
  task.measured.shapes.col(8) += task.measured.shapes.col(3);  // cos 45 deg with the fourth mode
  EXPECT_THAT(identify(task).judgement.warnings,
              Contains(HasSubstr("largest products 0.707 (modes 4 and 9)")));
}

}  // namespace
}  // namespace wishbone
