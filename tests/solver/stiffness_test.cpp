// Stiffness is measured while a run goes on: integrator `auto` changes to the method that takes less work, one that was asked
// for is kept and the run says what it costs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::build;
using testing::Built;
using testing::diagonal;
using ::testing::HasSubstr;
using testing::simulate;
using testing::Trajectory;

double statistic(const TransientSummary& summary, const std::string& name) {
  for (const auto& [key, value] : summary.statistics)
    if (key == name) return value;
  return 0;
}

/// A light cart that a spring and a strong damper draw back to where the spring is relaxed: m x'' = -k x - c x'.
struct Damped {
  double m = 0.01, k = 20, c = 2e4, x0 = 0.1;
  double fast() const { return (-c - std::sqrt(c * c - 4 * m * k)) / (2 * m); }
  double slow() const { return k / m / fast(); }
  /// From rest.
  double x(double t) const {
    return x0 * (fast() * std::exp(slow() * t) - slow() * std::exp(fast() * t)) / (fast() - slow());
  }
};

Built damped_cart(const Damped& d) {
  SystemBuilder b;
  const int cart = b.add_body("cart", d.m, diagonal(1, 1, 1), {Matrix3::Identity(), {2, 0, 0}});
  b.add_joint("slide", {}, cart, {0, 0, 0}, PrismaticJoint{Vector3::UnitX()});
  b.add_force(
      SpringDamper("spring", b.add_marker({}, Vector3::Zero()), b.add_marker({cart}), d.k, d.c, 2 - d.x0));
  return build(std::move(b));
}

TEST(Stiffness, IsNoticedByAutoWhichKeepsToTheClosedForm) {
  const Damped d;
  const Built m = damped_cart(d);
  const Trajectory run = simulate(m.system, m.state, 1000, 10, 1e-8, Method::automatic);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  ASSERT_EQ(run.summary.method_changes.size(), 1u);
  EXPECT_EQ(run.summary.method_changes[0].from.method, Method::erk);
  EXPECT_EQ(run.summary.method_changes[0].to.method, Method::bdf);
  EXPECT_LT(run.summary.method_changes[0].t, 0.01);
  EXPECT_TRUE(run.summary.warnings.empty());
  // explicit steps may not exceed 3.3 / 2e6 s: six hundred million would be needed
  EXPECT_LT(statistic(run.summary, "steps"), 5000);
  for (const State& s : run.states) EXPECT_NEAR(s.q[0], d.x(s.t) - d.x0, 1e-6) << s.t;
}

TEST(Stiffness, LeavesAMethodThatWasAskedForAndTellsWhatWouldBeFaster) {
  const Built m = damped_cart({});
  for (const Method method : {Method::erk, Method::adams}) {
    const Trajectory run = simulate(m.system, m.state, 0.1, 0.1, 1e-6, method);
    ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
    EXPECT_TRUE(run.summary.method_changes.empty());
    ASSERT_EQ(run.summary.warnings.size(), 1u) << to_string(method);
    EXPECT_THAT(run.summary.warnings[0].what, HasSubstr("times the work of bdf"));
  }
}

/// Two carts in a row under gravity, the first on a spring of any stiffness with 2 % damping, which bears `load` at the start
/// while the other spring bears 2 kN.
double corner_steps(double stiffness, double load) {
  SystemBuilder b;
  b.gravity = {-9.81, 0, 0};
  const double m = 40;
  const int wheel = b.add_body("wheel", m, diagonal(1, 1, 1), {Matrix3::Identity(), {0.3, 0, 0}});
  const int body = b.add_body("body", 400, diagonal(1, 1, 1), {Matrix3::Identity(), {0.8, 0, 0}});
  b.add_joint("guide", {}, wheel, {0, 0, 0}, PrismaticJoint{Vector3::UnitX()});
  b.add_joint("slide", {wheel}, body, {0, 0, 0}, PrismaticJoint{Vector3::UnitX()});
  b.add_force(SpringDamper("tire", b.add_marker({}, Vector3::Zero()), b.add_marker({wheel}), stiffness,
                           0.04 * std::sqrt(stiffness * m), 0.3 + load / stiffness));
  b.add_force(SpringDamper("strut", b.add_marker({wheel}), b.add_marker({body}), 20e3, 1500, 0.6));
  const Built built = build(std::move(b));
  const Trajectory run = simulate(built.system, built.state, 5, 0.1, 1e-6, Method::bdf);
  EXPECT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  return statistic(run.summary, "steps");
}

TEST(Stiffness, OfHardlyDampedVibrationsDoesNotShortenSteps) {
  const double balanced = 2000 + 40 * 9.81;
  const double soft = corner_steps(1e3, balanced);
  // between, at 1e8, the instability of high orders grows slowly and is found late: 18 times the steps
  for (const double stiffness : {1e6, 1e10, 1e12})
    EXPECT_LT(corner_steps(stiffness, balanced), 3 * soft) << stiffness;
}

TEST(Stiffness, OfHardlyDampedVibrationsIsFollowedUntilTheyHaveDecayed) {
  // ringing of 2 % falls below the tolerance within a hundred periods; followed to the end it would be 10^5 periods
  for (const double stiffness : {1e6, 1e8, 1e10, 1e12})
    EXPECT_LT(corner_steps(stiffness, 440 * 9.81), 10'000) << stiffness;
}

TEST(Stiffness, IsNotSeenInASmoothLongRun) {
  const Built m = damped_cart({2, 800, 0, 0.1});
  const Trajectory run = simulate(m.system, m.state, 100, 1, 1e-8, Method::automatic);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  EXPECT_TRUE(run.summary.method_changes.empty());
  EXPECT_TRUE(run.summary.warnings.empty());
  // the trials on the side leave no trace
  const Trajectory plain = simulate(m.system, m.state, 100, 1, 1e-8, Method::erk);
  ASSERT_EQ(run.states.size(), plain.states.size());
  for (std::size_t i = 0; i < run.states.size(); ++i) EXPECT_EQ(run.states[i].q[0], plain.states[i].q[0]);
}

}  // namespace
}  // namespace wishbone
