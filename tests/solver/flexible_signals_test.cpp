// What an observer tells of flexible bodies is what their laws say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "solver/mechanisms.h"
#include "solver/observer.h"

namespace wishbone {
namespace {

using testing::block_modes;
using testing::build;
using testing::Built;
using testing::Random;
using enum FlexibleSignal;

constexpr int kPulledModes = 8;

/// A block that spins and vibrates, pulled at two of its nodes.
Built pulled_block(int modes = kPulledModes) {
  SystemBuilder b;
  const int block = b.add_flexible_body("block", block_modes(modes), {Matrix3::Identity(), {1, 2, 3}});
  b.set_velocity(block, {3, 1, -2}, {1.5, -0.8, 2.5});
  b.add_force(AppliedLoad("pull", b.add_marker({block, 3}), {Vector3::Zero(), Vector3(50, 0, 10)}));
  b.add_force(AppliedLoad("turn", b.add_marker({block, 14}), {Vector3(5, 0, 0), Vector3::Zero()}));
  Built m = build(std::move(b));
  Random random(1);
  m.state.q.tail(modes) = random.numbers(modes, 0.1);
  m.state.v.tail(modes) = random.numbers(modes, 20);
  return m;
}

/// One row, by path.
std::map<std::string, VectorX> row_of(const Built& m, const ObserverOptions& options, Workspace& ws) {
  Observer observer(m.system, options);
  const std::span<const double> row = observer.sample(m.state, {}, ws);
  std::map<std::string, VectorX> values;
  const double* next = row.data();
  for (const Signal& signal : observer.signals()) {
    values[signal.path] = Eigen::Map<const VectorX>(next, signal.size());
    next += signal.size();
  }
  return values;
}
std::map<std::string, VectorX> row_of(const Built& m, const ObserverOptions& options) {
  Workspace ws(m.system);
  return row_of(m, options, ws);
}

ObserverOptions everything() {
  ObserverOptions options;
  options.flexible = {
      {0,
       {14, 3},
       {deflection_rates, modal_rates, modal_accelerations, energies, modal_energies, interface_forces}}};
  return options;
}

TEST(FlexibleSignals, AreRecordedWhereTheyAreAskedForOnly) {
  const Built m = pulled_block();
  const auto flexible = [&](const ObserverOptions& options) {
    std::vector<std::string> paths;
    for (const auto& [path, values] : row_of(m, options))
      if (path.starts_with("/flexible/block/")) paths.push_back(path.substr(16));
    return paths;
  };
  EXPECT_THAT(flexible({}), ::testing::ElementsAre("modal_coordinates"));
  EXPECT_THAT(flexible(everything()),
              ::testing::ElementsAre("deflection", "deflection_rate", "interface_force", "interface_moment",
                                     "kinetic_energy", "modal_accelerations", "modal_coordinates",
                                     "modal_kinetic_energy", "modal_rates", "modal_strain_energy",
                                     "strain_energy", "vibration_energy"));
}

TEST(FlexibleSignals, MotionOfTheModesAndNodesIsThatOfTheState) {
  const Built m = pulled_block();
  Workspace ws(m.system);
  auto row = row_of(m, everything(), ws);
  const VectorX z = m.state.q.tail(kPulledModes), z_dot = m.state.v.tail(kPulledModes);
  EXPECT_EQ(row["/flexible/block/modal_coordinates"], z);
  EXPECT_EQ(row["/flexible/block/modal_rates"], z_dot);
  EXPECT_EQ(row["/flexible/block/modal_accelerations"], ws.v_rate.tail(kPulledModes));
  const ModeSet modes = block_modes(kPulledModes);
  VectorX delta(6), rate(6);
  for (const int i : {0, 1}) {
    const auto Psi = modes.shapes.middleRows<3>(3 * modes.node_index(i == 0 ? 14 : 3));
    delta.segment<3>(3 * i) = Psi * z;
    rate.segment<3>(3 * i) = Psi * z_dot;
  }
  EXPECT_LT((row["/flexible/block/deflection"] - delta).norm(), 1e-14 * delta.norm());
  EXPECT_LT((row["/flexible/block/deflection_rate"] - rate).norm(), 1e-14 * rate.norm());
}

TEST(FlexibleSignals, EnergiesOfTheModesSumToThoseOfTheBody) {
  const Built m = pulled_block();
  Workspace ws(m.system);
  auto row = row_of(m, everything(), ws);
  const ModalBody& modal = m.system.flexible[0].modal;
  const VectorX& strain = row["/flexible/block/modal_strain_energy"];
  const VectorX& vibration = row["/flexible/block/modal_kinetic_energy"];
  EXPECT_GT(strain.minCoeff(), 0);
  EXPECT_GT(vibration.minCoeff(), 0);
  for (int j = 0; j < kPulledModes; ++j)
    EXPECT_NEAR(strain[j] + vibration[j], modal.mode_energy(j, ws.flexible[0].modal),
                1e-14 * (strain[j] + vibration[j]));
  EXPECT_NEAR(row["/flexible/block/strain_energy"][0], strain.sum(), 1e-13 * strain.sum());
  EXPECT_NEAR(row["/flexible/block/vibration_energy"][0], vibration.sum(), 1e-13 * vibration.sum());
  // the only body: its energies are those of the system
  EXPECT_EQ(row["/flexible/block/strain_energy"][0], row["/energy/elastic"][0]);
  EXPECT_EQ(row["/flexible/block/kinetic_energy"][0], row["/energy/kinetic"][0]);
}

// 2 T = m v^2 + w.J w + 2 w.S z' + z'.z': a body that neither moves nor turns as a whole has the energy of its modes.
TEST(FlexibleSignals, VibrationAloneIsAllTheKineticEnergyOfABodyAtRest) {
  Built m = pulled_block();
  m.state.v.head(6).setZero();
  auto row = row_of(m, everything());
  EXPECT_NEAR(row["/flexible/block/kinetic_energy"][0], row["/flexible/block/vibration_energy"][0],
              1e-13 * row["/flexible/block/kinetic_energy"][0]);
}

TEST(FlexibleSignals, InterfaceForcesStandInTheOrderOfTheirNodes) {
  const Built m = pulled_block();
  Observer observer(m.system, everything());
  for (const Signal& signal : observer.signals())
    if (signal.path.starts_with("/flexible/block/interface_")) {
      EXPECT_EQ(signal.frame, "body");
      EXPECT_THAT(signal.shape, ::testing::ElementsAre(2, 3));
      EXPECT_THAT(signal.lists.at("nodes"), ::testing::ElementsAre("3", "14"));
    }
  auto row = row_of(m, everything());
  // the body axes are still those of the world
  EXPECT_EQ(row["/flexible/block/interface_force"], (VectorX(6) << 50, 0, 10, 0, 0, 0).finished());
  EXPECT_EQ(row["/flexible/block/interface_moment"], (VectorX(6) << 0, 0, 0, 5, 0, 0).finished());
  EXPECT_EQ(row["/loads/pull/force"], VectorX(Vector3(50, 0, 10)));
  EXPECT_EQ(row["/loads/turn/moment"], VectorX(Vector3(5, 0, 0)));
}

TEST(FlexibleSignals, RecoveryIsTheMatrixTimesTheModalCoordinates) {
  const Built m = pulled_block();
  // the third mode alone is recovered by the third column
  Built third = m;
  third.state.q.tail(kPulledModes).setZero();
  third.state.q.tail(kPulledModes)[2] = 0.25;
  ObserverOptions options;
  MatrixX R = MatrixX::Zero(2, kPulledModes);
  R.col(2) << 8e6, -4e6;
  R.col(5) << 1e6, 2e6;
  options.recoveries = {{"stress", "Pa", 0, {"top", "bottom"}, R}};
  EXPECT_EQ(row_of(third, options)["/recovery/stress"], VectorX(Eigen::Vector2d(2e6, -1e6)));
  const VectorX all = R * m.state.q.tail(kPulledModes);
  EXPECT_LT((row_of(m, options)["/recovery/stress"] - all).norm(), 1e-14 * all.norm());
}

TEST(FlexibleSignals, OfABodyWithoutModesAreThoseThatNeedNone) {
  auto row = row_of(pulled_block(0), everything());
  EXPECT_FALSE(row.contains("/flexible/block/modal_coordinates"));
  EXPECT_FALSE(row.contains("/flexible/block/modal_strain_energy"));
  EXPECT_EQ(row["/flexible/block/strain_energy"][0], 0);
  EXPECT_EQ(row["/flexible/block/deflection"].norm(), 0);
  EXPECT_EQ(row["/flexible/block/interface_force"].head<3>(), Vector3(50, 0, 10));
}

TEST(FlexibleSignals, OfARigidBodyAreNone) {
  SystemBuilder b;
  b.add_body("block", 1, Matrix3::Identity(), {});
  ObserverOptions options = everything();
  options.recoveries = {{"stress", "Pa", 0, {"1"}, MatrixX::Ones(1, 3)}};
  for (const auto& [path, values] : row_of(build(std::move(b)), options)) {
    EXPECT_FALSE(path.starts_with("/flexible/")) << path;
    EXPECT_FALSE(path.starts_with("/recovery/")) << path;
  }
}

}  // namespace
}  // namespace wishbone
