// Random mechanisms against Simbody, another engine with its own joints, closures and integrators. The mechanisms are
// exchanged as plain data and the states as motions of bodies in the world, so that no coordinates need match.
#include <gtest/gtest.h>

#include <set>
#include <string>

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
using testing::Random;
using testing::SimbodyAnswer;

constexpr double kSimulatedTime = 1;  // [s]
constexpr double kAccuracy = 1e-12;   // of both integrators

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

struct Drawn {
  Mechanism mechanism;
  Built built;
};

/// Every other mechanism has closures.
Drawn drawn(int seed) {
  Random random(static_cast<unsigned>(seed));
  const bool closed = seed % 2 == 0;
  Likeness likeness;
  likeness.bodies = random.index(13) + 8;
  likeness.closures = closed ? likeness.bodies / 2 : 0;
  likeness.common_closures = true;
  Drawn drawn;
  drawn.mechanism = random_mechanism(likeness, random);
  drawn.built = in_random_state(drawn.mechanism, random);
  EXPECT_EQ(closed, !drawn.mechanism.closures.empty()) << "seed " << seed;
  return drawn;
}

class SimbodyComparison : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (!testing::simbody_is_installed()) GTEST_SKIP() << "Simbody (libsimbody-dev) is not installed";
  }
};
INSTANTIATE_TEST_SUITE_P(Seeds, SimbodyComparison, ::testing::Range(1, 11),
                         [](const auto& p) { return std::to_string(p.param); });

void expect_same_instant(const Drawn& d) {
  const System& system = d.built.system;
  const BodyMotions start = motions_of(system, d.built.state);
  const SimbodyAnswer simbody = ask_simbody(d.mechanism, start, 0, kAccuracy);
  EXPECT_LT(difference(start.poses, simbody.start.poses), 1e-12);
  EXPECT_LT(difference(start.velocities, simbody.start.velocities), 1e-12);

  Workspace ws = testing::with_independent_rows(d.built);
  calc_forward_dynamics(system, d.built.state, ws);
  calc_reactions(system, ws);
  std::vector<Vector6> accelerations, joint_reactions, closure_reactions;
  for (int i = 0; i < static_cast<int>(ws.bodies.size()); ++i) {
    accelerations.push_back(ws.bodies[i].A);
    // Simbody's are about the outboard point Mo of the joint
    const Vector3 p_WMo = ws.bodies[i].X_WB.p - ws.bodies[i].p_MB;
    const Vector6 on_first =
        shift_wrench<double>(tree_joint_reaction(system, ws, i), tree_joint_point(system, ws, i) - p_WMo);
    joint_reactions.push_back(system.bodies[i].first_is_child ? on_first : Vector6(-on_first));
  }
  for (const Closure& closure : system.closures)
    closure_reactions.push_back(closure_wrench(closure, 0, ws.lambda, ws));
  EXPECT_LT(difference(accelerations, simbody.accelerations), 1e-10);
  EXPECT_LT(difference(joint_reactions, simbody.joint_reactions), 1e-10);
  if (closure_reactions.empty()) return;
  EXPECT_LT(difference(closure_reactions, simbody.closure_reactions), 1e-10);
}

TEST_P(SimbodyComparison, FindsTheSameAccelerationsAndReactions) {
  for (int i = 0; i < 5; ++i) {
    const int seed = GetParam() + 10 * i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_instant(drawn(seed));
  }
}

TEST_P(SimbodyComparison, ArrivesAtTheSamePlace) {
  const auto [mechanism, built] = drawn(GetParam());
  const SimbodyAnswer simbody =
      ask_simbody(mechanism, motions_of(built.system, built.state), kSimulatedTime, kAccuracy);
  const testing::Trajectory run =
      testing::simulate(built.system, built.state, kSimulatedTime, kSimulatedTime, kAccuracy);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  const BodyMotions end = motions_of(built.system, run.last());
  EXPECT_LT(difference(end.poses, simbody.end.poses), 1e-8);
}

TEST(SimbodyComparisons, TryEveryJointAndEveryClosureThatSimbodyHas) {
  std::set<std::string> joints, closures;
  for (int seed = 1; seed <= 50; ++seed) {
    const Mechanism mechanism = drawn(seed).mechanism;
    for (const auto& joint : mechanism.joints) joints.emplace(info(joint.kind).name);
    for (const auto& closure : mechanism.closures) closures.emplace(joint_kind(closure.joint));
  }
  EXPECT_EQ(joints.size(), 10u);
  EXPECT_EQ(closures,
            (std::set<std::string>{"cylindrical", "distance", "fixed", "planar", "point_on_line",
                                   "point_on_plane", "prismatic", "revolute", "spherical", "universal"}));
}

}  // namespace
}  // namespace wishbone
