// Edges of force laws: passages are found, even together, and the motion between them is exact.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "solver/events.h"
#include "solver/kinematics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::build;
using testing::Built;
using testing::diagonal;
using testing::simulate;
using testing::Trajectory;

constexpr double kMass = 2, kStiffness = 5e4, kSpeed = 3, kGap = 0.4;

/// Blocks that slide without friction between two walls of linear stiffness, each `offset` further from the origin: where
/// their travel is measured their numbers differ by rounding.
Built blocks_between_walls(int count, double offset) {
  SystemBuilder b;
  for (int i = 0; i < count; ++i) {
    const Vector3 p(i * offset, i, 0);
    const int block = b.add_body("block", kMass, diagonal(1, 1, 1), {Matrix3::Identity(), p});
    b.add_joint("slide", {}, block, p, PrismaticJoint(Vector3::UnitX()), {{0}, {kSpeed}, {1}});
    b.add_force(JointLimit("walls", b.add_marker({}), b.add_marker({block}),
                           Gauge{Gauge::Kind::translation, 0}, i * offset - kGap, i * offset + kGap,
                           {kStiffness, 1, 0}));
  }
  return build(std::move(b));
}

/// Travel after a time: straight at the speed v, and half a period of the oscillator in every contact.
double travel(double t) {
  const double omega = std::sqrt(kStiffness / kMass), contact = std::numbers::pi / omega;
  const double half_period = 2 * kGap / kSpeed + contact;
  t += kGap / kSpeed;  // since the lower wall was left
  const double halves = std::floor(t / half_period);
  const double sign = std::fmod(halves, 2) == 0 ? 1 : -1;
  t -= halves * half_period;
  if (t < 2 * kGap / kSpeed) return sign * (kSpeed * t - kGap);
  return sign * (kGap + kSpeed / omega * std::sin(omega * (t - 2 * kGap / kSpeed)));
}

class Walls : public ::testing::TestWithParam<Method> {};

TEST_P(Walls, ReturnABlockAsTheOscillatorThatTheyAre) {
  const Built m = blocks_between_walls(1, 0);
  const Trajectory run = simulate(m.system, m.state, 2, 0.1, 1e-10, GetParam());
  EXPECT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  for (const State& state : run.states) EXPECT_NEAR(state.q[0], travel(state.t), 1e-6) << "t = " << state.t;
}

TEST_P(Walls, CostARestartAtEveryPassage) {
  const Built m = blocks_between_walls(1, 0);
  const double half_period = 2 * kGap / kSpeed + std::numbers::pi / std::sqrt(kStiffness / kMass);
  const long walls = std::lround(std::floor((2 + kGap / kSpeed) / half_period));
  EXPECT_EQ(simulate(m.system, m.state, 2, 0.1, 1e-8, GetParam()).summary.restarts, 2 * walls);
}

INSTANTIATE_TEST_SUITE_P(, Walls, ::testing::Values(Method::erk, Method::adams, Method::bdf),
                         [](const auto& p) { return to_string(p.param); });

TEST(Edges, AreLeftAlsoByTheOneThatStandsOnThemUnseen) {
  // the first block is found on its wall, the second stands there but for rounding, the third is inside
  Built m = blocks_between_walls(3, 0);
  Workspace ws(m.system);
  m.state.q << kGap, std::nextafter(kGap, 1), kGap / 2;
  ws.memory.segments = {1, 1, 1};
  update_positions<double>(m.system, 0, m.state.q, ws);
  update_markers<double>(m.system, ws);
  pass_edges(m.system, std::array{1}, ws);
  EXPECT_EQ(ws.memory.segments, (std::vector{2, 2, 1}));
}

}  // namespace
}  // namespace wishbone
