// Assembling: what can be closed is closed, what is redundant is named, what is wrong is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using ::testing::AllOf;
using testing::build;
using testing::Built;
using testing::diagonal;
using testing::four_bar;
using ::testing::HasSubstr;

std::string refusal(Built& m) {
  Workspace ws(m.system);
  try {
    assemble(m.system, m.state, ws);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// A car's link: a rigid body on two spherical joints to the ground, the second one cut, `gap` too far away along the link.
Built link_on_two_balls(double gap, const Vector3& rear = Vector3::Zero()) {
  SystemBuilder b;
  const int link =
      b.add_body("link", 2, diagonal(1, 1, 1), {Matrix3::Identity(), rear + Vector3(0.3, 0.2, 0)});
  b.add_joint("rear ball", {}, link, rear, SphericalJoint{});
  b.add_closure("front ball", b.add_marker({link}, rear + Vector3(0.6, 0, 0)),
                b.add_marker({}, rear + Vector3(0.6 + gap, 0, 0)), SphericalClosure{});
  return build(std::move(b));
}

TEST(Assembly, NamesTheRowAlongALinkBetweenTwoBallsAsRedundant) {
  Built m = link_on_two_balls(0);
  Workspace ws(m.system);
  const AssemblyReport report = assemble(m.system, m.state, ws);
  ASSERT_EQ(report.redundant_rows, std::vector<int>{0});
  EXPECT_EQ(m.system.row_name(0), "front ball (x)");
  EXPECT_LE(report.position_residual, 1e-12);
}

TEST(Assembly, ClosesFarFromTheOriginAsWellAsPositionsAreKnownThere) {
  Built m = link_on_two_balls(0, {3e6, -1e6, 7});
  retract(m.system, VectorX::Constant(m.system.nv, 0.01), m.state.q);
  Workspace ws(m.system);
  const AssemblyReport report = assemble(m.system, m.state, ws);
  EXPECT_LE(report.position_residual, 1e-8);  // a dozen roundings of 3e6 m
  EXPECT_TRUE(project(m.system, kProjectionTolerance, m.state, ws));
}

TEST(Assembly, RefusesALinkOfTheWrongLengthWithItsGap) {
  Built m = link_on_two_balls(0.001);
  EXPECT_THAT(refusal(m), AllOf(HasSubstr("front ball (x)"), HasSubstr("0.001")));
}

TEST(Assembly, RefusesALoopThatCannotReach) {
  // two rods of 1 m over a span of 3 m
  SystemBuilder b;
  const int rod = b.add_body("rod", 1, diagonal(1, 1, 1), {Matrix3::Identity(), {0.5, 0.3, 0}});
  const int other = b.add_body("other", 1, diagonal(1, 1, 1), {Matrix3::Identity(), {2.5, 0.3, 0}});
  b.add_joint("left", {}, rod, {0, 0, 0}, RevoluteJoint{});
  b.add_joint("right", {}, other, {3, 0, 0}, RevoluteJoint{});
  b.add_closure("middle", b.add_marker({rod}, {0.8, 0.6, 0}), b.add_marker({other}, {2.2, 0.6, 0}),
                SphericalClosure{});
  Built m = build(std::move(b));
  EXPECT_THAT(refusal(m), HasSubstr("middle"));
}

TEST(Assembly, ClosesAMechanismThatStartsOpen) {
  for (const CutJoint& cut : {CutJoint(SphericalClosure{}), CutJoint(RevoluteClosure{})})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Built m = four_bar(cut, 2.0);
      testing::Random random(seed);
      retract(m.system, random.numbers(m.system.nv, 0.05), m.state.q);
      m.state.v += random.numbers(m.system.nv, 0.1);
      Workspace ws(m.system);
      const AssemblyReport report = assemble(m.system, m.state, ws);
      EXPECT_LE(report.position_residual, 1e-12) << "seed " << seed;
      EXPECT_LE(report.velocity_residual, 1e-11) << "seed " << seed;
    }
}

TEST(Assembly, FindsTheRedundancyOfALoopInSpaceThatStartsOpen) {
  // off its closed poses, no row of a spatial loop is redundant: the rank must be taken where the loop is closed
  SystemBuilder b;
  const int crank = b.add_body("crank", 1, diagonal(0.01, 0.1, 0.1), {Matrix3::Identity(), {0.5, 0, 0}});
  const int link = b.add_body("link", 1, diagonal(1, 1, 1), {Matrix3::Identity(), {1, 0.5, 0}});
  b.add_joint("pivot", {}, crank, {0, 0, 0}, RevoluteJoint{Vector3::UnitZ()});
  b.add_joint("ball", {crank}, link, {1, 0, 0}, SphericalJoint{});
  const MarkerIndex crank_tip = b.add_marker({crank}, {1, 1, 0}), link_tip = b.add_marker({link}, {1, 1, 0});
  b.add_closure("second ball", crank_tip, link_tip, SphericalClosure{});
  Built m = build(std::move(b));
  testing::Random random(3);
  retract(m.system, random.numbers(m.system.nv, 0.02), m.state.q);
  Workspace ws(m.system);
  const AssemblyReport report = assemble(m.system, m.state, ws);
  EXPECT_EQ(report.redundant_rows, std::vector<int>{1});
  EXPECT_LE(report.position_residual, 1e-12);
}

TEST(Assembly, IsTheNearestPoseInTheMetricOfInertia) {
  // the momentum that a projection adds has no component along the motions that stay possible: d^T M n = 0 for D n = 0.
  // Here the projection of speeds, linear, so exactly.
  Built m = four_bar(SphericalClosure{}, 2.0);
  Workspace ws = testing::assembled(m);
  const State closed = m.state;
  State kicked = closed;
  kicked.v += testing::Random(1).numbers(m.system.nv, 1.0);
  State projected = kicked;
  project(m.system, kProjectionTolerance, projected, ws);
  const auto kinetic = [&](const VectorX& v) {
    State s = closed;
    s.v = v;
    update_state(m.system, s, ws);
    return calc_energy(m.system, s, ws).kinetic;
  };
  // Pythagoras: T(kicked - closed') = T(kicked - projected) + T(projected - closed'), for any consistent closed'
  EXPECT_NEAR(kinetic(kicked.v - closed.v), kinetic(kicked.v - projected.v) + kinetic(projected.v - closed.v),
              1e-11);
}

}  // namespace
}  // namespace wishbone
