// Rigid mechanisms whose motion is known in closed form or was computed independently in quadruple precision.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::build;
using testing::Built;
using testing::diagonal;
using testing::energy_balance;
using testing::momentum;
using testing::simulate;
using testing::Trajectory;

constexpr double kG = 9.81;

/// A point mass on a massless rod, at `angle` from the downward vertical.
Built make_pendulum(double length, double angle) {
  SystemBuilder b;
  b.gravity = Vector3(0, -kG, 0);
  const Vector3 p(length * std::sin(angle), -length * std::cos(angle), 0);
  const int bob = b.add_body("bob", 1.0, Matrix3::Zero(), {Matrix3::Identity(), p});
  b.add_joint("pivot", {}, bob, Vector3::Zero(), RevoluteJoint{Vector3::UnitZ()});
  return build(std::move(b));
}

TEST(RigidClosedForms, ProjectileFollowsItsParabolaWhileItTumbles) {
  SystemBuilder b;
  b.gravity = Vector3(0, 0, -kG);
  const int stone = b.add_body("stone", 2.5, diagonal(0.1, 0.3, 0.2), {});
  const Vector3 v0(3, -1, 20);
  b.set_velocity(stone, v0, {1, 2, 3});
  const Built m = build(std::move(b));
  const Trajectory run = simulate(m.system, m.state, 4.0, 0.5, 1e-10);
  for (const State& s : run.states) {
    const Vector3 exact = v0 * s.t + 0.5 * s.t * s.t * Vector3(0, 0, -kG);
    EXPECT_LT((s.q.segment<3>(4) - exact).norm(), 1e-10 * (1 + exact.norm())) << "t = " << s.t;
  }
}

TEST(RigidClosedForms, TorqueFreeTopKeepsEnergyAndAngularMomentumFor100Seconds) {
  // reference: torque_free_asymmetric_top, generic case (quadruple precision, two methods, Jacobi closed form)
  SystemBuilder b;
  const int top = b.add_body("top", 1.0, diagonal(1, 2, 3), {});
  b.set_velocity(top, Vector3::Zero(), {1.0, 0.5, 0.8});
  const Built m = build(std::move(b));
  const Trajectory run = simulate(m.system, m.state, 100.0, 1.0, 1e-10);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;

  const double E0 = energy_balance(m.system, run.states.front(), {});
  const Vector6 h0 = momentum(m.system, run.states.front());
  for (const State& s : run.states) {
    EXPECT_NEAR(energy_balance(m.system, s, {}), E0, 1e-9 * E0);
    EXPECT_LT((momentum(m.system, s) - h0).norm(), 1e-9 * h0.norm()) << "t = " << s.t;
  }
  const Eigen::Vector4d exact(7.15401938045053785e-02, -3.13690704852154371e-01, -4.67159246132691487e-01,
                              -8.23554722597416570e-01);
  const Eigen::Vector4d q = run.last().q.head<4>() * (run.last().q.head<4>().dot(exact) > 0 ? 1 : -1);
  EXPECT_LT((q - exact).norm(), 1e-8);
}

TEST(RigidClosedForms, PendulumPeriodIsTheEllipticIntegral) {
  // reference: IFToMM A01, phi(0) = -pi/2: period 4 K(sin(pi/4)) sqrt(L/g) = 2.36784194757623744 s
  const Built m = make_pendulum(1.0, -M_PI / 2);
  const Trajectory run = simulate(m.system, m.state, 10.0, 0.01, 1e-12);
  const State& s = run.last();
  // the joint coordinate starts at zero in the design pose
  EXPECT_NEAR(s.q[0] - M_PI / 2, -2.78680673569982948434767e-01, 1e-9);
  EXPECT_NEAR(s.v[0], 4.34316069286468305328527e+00, 1e-9);

  // time of the second upward passage through the start is one period: find it from the recorded motion
  const double period = 2.36784194757623744237;
  const Trajectory one = simulate(m.system, m.state, period, period / 4, 1e-12);
  EXPECT_NEAR(one.last().q[0], 0.0, 1e-10);
  EXPECT_NEAR(one.last().v[0], 0.0, 1e-9);
}

TEST(RigidClosedForms, DoublePendulumMatchesQuadruplePrecision) {
  // reference: double_pendulum (two formulations in quadruple precision); point masses, unit lengths
  SystemBuilder b;
  b.gravity = Vector3(0, -kG, 0);
  const int first = b.add_body("first", 1.0, Matrix3::Zero(), {Matrix3::Identity(), {1, 0, 0}});
  const int second = b.add_body("second", 1.0, Matrix3::Zero(), {Matrix3::Identity(), {2, 0, 0}});
  b.add_joint("pivot", {}, first, {0, 0, 0}, RevoluteJoint{Vector3::UnitZ()});
  b.add_joint("elbow", {first}, second, {1, 0, 0}, RevoluteJoint{Vector3::UnitZ()});
  const Built m = build(std::move(b));
  const Trajectory run = simulate(m.system, m.state, 5.0, 1.0, 1e-12);
  struct Sample {
    int t;
    double th1, th2;  // from the downward vertical
  };
  for (const auto& [t, th1, th2] : {Sample{1, -6.250876998063906299541e-01, -1.034585085680012340612e+00},
                                    {2, -4.829715342517543774491e-01, -1.324048712302362548786e+00},
                                    {3, 1.785795522077416676215e+00, 1.118107461205155440445e+00},
                                    {5, -6.271867050665307301381e-01, -1.301315550209811677908e+00}}) {
    const State& s = run.states[t];
    EXPECT_NEAR(s.q[0] + M_PI / 2, th1, 1e-9) << "t = " << t;
    EXPECT_NEAR(s.q[0] + s.q[1] + M_PI / 2, th2, 1e-9) << "t = " << t;
  }
}

TEST(RigidClosedForms, SpringDamperDecaysExponentially) {
  // m x'' + c x' + k (x - l0) = 0: x - l0 = a exp(-d t) (cos w t + d/w sin w t)
  const double mass = 2, k = 200, c = 4, l0 = 1, a = 0.3;
  SystemBuilder b;
  const int cart = b.add_body("cart", mass, diagonal(1, 1, 1), {Matrix3::Identity(), {l0 + a, 0, 0}});
  b.add_joint("slide", {}, cart, {0, 0, 0}, PrismaticJoint{Vector3::UnitX()});
  const MarkerIndex P = b.add_marker({}, Vector3::Zero());
  const MarkerIndex Q = b.add_marker({cart});
  b.add_force(SpringDamper("spring", P, Q, k, c, l0));
  const Built m = build(std::move(b));
  const double d = c / (2 * mass), w = std::sqrt(k / mass - d * d);
  // The tolerance bounds the error of one step; what 3 s of steps make of it is a matter of the method: a digit with the
  // one-step pair and Adams, two more with BDF. An error in x of the tolerance is one in energy of k a times that.
  const double tolerance = 1e-10;
  for (const auto& [method, loss] :
       {std::pair(Method::erk, 10.0), {Method::adams, 10.0}, {Method::bdf, 100.0}}) {
    const Trajectory run = simulate(m.system, m.state, 3.0, 0.05, tolerance, method);
    for (std::size_t i = 0; i < run.states.size(); ++i) {
      const State& s = run.states[i];
      const double x = a * std::exp(-d * s.t) * (std::cos(w * s.t) + d / w * std::sin(w * s.t));
      EXPECT_NEAR(s.q[0] + a, x, loss * tolerance) << to_string(method) << " t = " << s.t;
      EXPECT_NEAR(energy_balance(m.system, s, run.work[i]), 0.0, k * a * loss * tolerance)
          << to_string(method) << " t = " << s.t;
    }
  }
}

}  // namespace
}  // namespace wishbone
