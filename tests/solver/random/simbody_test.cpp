// Random mechanisms against Simbody, another engine with its own joints, closures and integrators. The mechanisms are
// exchanged as plain data and the states as motions of bodies in the world, so that no coordinates need match.
#include <gtest/gtest.h>

#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/random/random_mechanism.h"
#include "solver/random/simbody_exchange.h"
#include "solver/reactions.h"

namespace wishbone {
namespace {

using testing::ask_simbody;
using testing::BodyMotions;
using testing::Built;
using testing::Likeness;
using testing::Mechanism;
using testing::SimbodyAnswer;

constexpr double kDuration = 1;      // [s]
constexpr double kAccuracy = 1e-12;  // of both integrators

BodyMotions motions_of(const System& system, const State& state) {
  Workspace ws(system);
  update_state(system, state, ws);
  BodyMotions motions;
  for (const BodyMotion& body : ws.bodies) {
    motions.poses.push_back(body.X_WB);
    motions.velocities.push_back(body.V);
  }
  return motions;
}

VectorX stacked(const std::vector<Vector6>& spatials) {
  return Eigen::Map<const VectorX>(spatials.front().data(), 6 * static_cast<Eigen::Index>(spatials.size()));
}

VectorX stacked(const std::vector<Pose>& poses) {
  MatrixX columns(12, poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) << poses[i].R.reshaped(), poses[i].p;
  return columns.reshaped();
}

/// Relative to the length of all together.
template <class List>
double difference(const List& found, const List& expected) {
  return (stacked(found) - stacked(expected)).norm() / stacked(expected).norm();
}

/// A mechanism drawn by its seed, in two ways.
class RandomMechanism : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (!testing::simbody_is_installed()) GTEST_SKIP() << "Simbody (libsimbody-dev) is not installed";
    const int seed = GetParam();
    testing::Random random(static_cast<unsigned>(seed));
    // five open mechanisms and five closed ones, from 4 to 20 bodies
    const int bodies = 4 + 4 * ((seed - 1) % 5);
    mechanism_ = random_mechanism({.bodies = bodies, .closures = seed > 5 ? bodies / 2 : 0}, random);
    built_ = in_random_state(mechanism_, random);
    simbody_ = ask_simbody(mechanism_, motions_of(built_.system, built_.state), kDuration, kAccuracy);
  }

  Mechanism mechanism_;
  Built built_;
  SimbodyAnswer simbody_;
};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomMechanism, ::testing::Range(1, 11),
                         [](const auto& p) { return std::to_string(p.param); });

TEST_P(RandomMechanism, StandsAndMovesAsInSimbody) {
  const BodyMotions start = motions_of(built_.system, built_.state);
  EXPECT_LT(difference(start.poses, simbody_.start.poses), 1e-12);
  EXPECT_LT(difference(start.velocities, simbody_.start.velocities), 1e-11);
}

TEST_P(RandomMechanism, AcceleratesAsInSimbody) {
  Workspace ws = testing::with_independent_rows(built_);
  calc_forward_dynamics(built_.system, built_.state, ws);
  std::vector<Vector6> accelerations, joint_reactions, closure_reactions;
  calc_reactions(built_.system, ws);
  for (int i = 0; i < static_cast<int>(ws.bodies.size()); ++i) {
    accelerations.push_back(ws.bodies[i].A);
    const Vector6 on_first = tree_joint_reaction(built_.system, ws, i);
    joint_reactions.push_back(mechanism_.joints[i].reversed ? on_first : Vector6(-on_first));
  }
  for (const Closure& closure : built_.system.closures)
    closure_reactions.push_back(closure_wrench(closure, 0, ws.lambda, ws));
  EXPECT_LT(difference(accelerations, simbody_.accelerations), 1e-10);
  EXPECT_LT(difference(joint_reactions, simbody_.joint_reactions), 1e-10);
  if (closure_reactions.empty()) return;
  EXPECT_LT(difference(closure_reactions, simbody_.closure_reactions), 1e-10);
}

TEST_P(RandomMechanism, ArrivesWhereItDoesInSimbody) {
  const testing::Trajectory run =
      testing::simulate(built_.system, built_.state, kDuration, kDuration, kAccuracy);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  const BodyMotions end = motions_of(built_.system, run.last());
  EXPECT_LT(difference(end.poses, simbody_.end.poses), 1e-8);
}

}  // namespace
}  // namespace wishbone
