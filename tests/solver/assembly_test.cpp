// Assembling: what can be closed is closed, what is redundant is named, what is wrong is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/error.h"
#include "solver/dense_dynamics.h"
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

/// What nearest means: d^T M n = 0 for every motion n that the closures leave, D n = 0, d the displacement from q0.
void expect_nearest(const Built& m, const VectorX& q0) {
  VectorX d(m.system.nv);
  calc_displacement(m.system, q0, m.state.q, d);
  ASSERT_GT(d.norm(), 1e-3) << "it had to be closed";
  const VectorX pull = testing::mass_matrix_from_energy(m.system, m.state) * d;
  const MatrixX D = testing::closure_jacobian_from_differences(m.system, m.state);
  Eigen::FullPivLU<MatrixX> lu(D);
  lu.setThreshold(1e-8);
  const MatrixX motions = lu.kernel();
  ASSERT_GT(motions.norm(), 0);
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    EXPECT_LT(std::abs(motions.col(k).dot(pull)), 1e-8 * motions.col(k).norm() * pull.norm());
}

TEST(Assembly, FindsThePoseThatNoMotionBringsNearer) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed);
    for (Built m : {four_bar(RevoluteClosure{}, 0), link_on_two_balls(0)}) {
      retract(m.system, random.numbers(m.system.nv, 0.05), m.state.q);
      const VectorX q0 = m.state.q;
      testing::assembled(m);
      expect_nearest(m, q0);
    }
  }
}

/// A bead of 2 kg that slides along y in a slide of 3 kg that slides along x, tied to the origin by a rod of 1 m.
struct Bead {
  static constexpr double x0 = 1.3, y0 = 0.5;
  static Built make(double x_weight, double y_weight) {
    SystemBuilder b;
    const Pose at{Matrix3::Identity(), {x0, y0, 0}};
    const int slide = b.add_body("slide", 3, diagonal(1, 1, 1), at),
              bead = b.add_body("bead", 2, diagonal(1, 1, 1), at);
    b.add_joint("x", {}, slide, at.p, PrismaticJoint{Vector3::UnitX()}, {{}, {}, {x_weight}});
    b.add_joint("y", {slide}, bead, at.p, PrismaticJoint{Vector3::UnitY()}, {{}, {}, {y_weight}});
    b.add_closure("rod", b.add_marker({}), b.add_marker({bead}), DistanceClosure("rod", 1));
    return build(std::move(b));
  }
  /// The angle on the circle at which 5 x_weight dx^2 + 2 y_weight dy^2 is least, by bisection of its slope.
  static double angle(double x_weight, double y_weight) {
    const auto slope = [&](double a) {
      return -5 * x_weight * (std::cos(a) - x0) * std::sin(a) +
             2 * y_weight * (std::sin(a) - y0) * std::cos(a);
    };
    double low = 0, high = M_PI / 2;
    for (int halving = 0; halving < 60; ++halving) {
      const double mid = (low + high) / 2;
      (slope(mid) < 0 ? low : high) = mid;
    }
    return low;
  }
};

TEST(Assembly, PutsABeadOnItsCircleWhereTheWeightedDistanceIsLeast) {
  double last_change_of_y = 1;
  for (const auto& [x_weight, y_weight] :
       {std::pair(1.0, 1.0), {10.0, 1.0}, {1.0, 10.0}, {1.0, 1e3}, {1e3, 1e3}, {1e-3, 1e-2}}) {
    Built m = Bead::make(x_weight, y_weight);
    testing::assembled(m);
    const double a = Bead::angle(x_weight, y_weight);
    EXPECT_NEAR(m.state.q[0], std::cos(a) - Bead::x0, 1e-9) << x_weight << ", " << y_weight;
    EXPECT_NEAR(m.state.q[1], std::sin(a) - Bead::y0, 1e-9) << x_weight << ", " << y_weight;
    if (x_weight == 1.0) {  // the heavier a coordinate is made, the less it moves
      EXPECT_LT(std::abs(m.state.q[1]), last_change_of_y);
      last_change_of_y = std::abs(m.state.q[1]);
    }
  }
}

/// Two rods of 1 m from the feet (0, 0) and (span, 0), standing at an angle on the side y > 0 or y < 0.
Built pair_of_rods(double span, double side) {
  SystemBuilder b;
  const Vector3 left(0, 0, 0), right(span, 0, 0), out(0.8, side * 0.6, 0), back(-0.8, side * 0.6, 0);
  const int rod = b.add_body("rod", 1, diagonal(1, 1, 1), {Matrix3::Identity(), left + out / 2});
  const int other = b.add_body("other", 1, diagonal(1, 1, 1), {Matrix3::Identity(), right + back / 2});
  b.add_joint("left", {}, rod, left, RevoluteJoint{});
  b.add_joint("right", {}, other, right, RevoluteJoint{});
  b.add_closure("apex", b.add_marker({rod}, left + out), b.add_marker({other}, right + back),
                SphericalClosure{});
  return build(std::move(b));
}

TEST(Assembly, KeepsTheBranchThatTheGivenPoseIsOn) {
  for (const double side : {1.0, -1.0}) {
    Built m = pair_of_rods(1.5, side);
    Workspace ws = testing::assembled(m);
    EXPECT_LT((ws.markers[0].p_WM - Vector3(0.75, side * std::sqrt(1 - 0.75 * 0.75), 0)).norm(), 1e-12);
  }
}

TEST(Assembly, TellsTheGapThatRemainsWhereTheLoopReachesFarthest) {
  Built m = pair_of_rods(3, 1);
  EXPECT_THAT(refusal(m), HasSubstr("'apex' by 1 m"));
}

}  // namespace
}  // namespace wishbone
