// The forms and methods of integration: agreement, order, closure, stops, determinism.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::assembled;
using testing::build;
using testing::Built;
using testing::diagonal;
using testing::energy_balance;
using testing::four_bar;
using testing::simulate;
using testing::Trajectory;

struct Scheme {
  Form form;
  Method method;
};
std::string name(const Scheme& s) {
  return std::string(to_string(s.form)) + " " + to_string(s.method);
}

constexpr Scheme kClosedSchemes[] = {
    {Form::index1, Method::erk}, {Form::index1, Method::bdf}, {Form::ggl, Method::bdf}};
constexpr Scheme kOpenSchemes[] = {
    {Form::ode, Method::erk}, {Form::ode, Method::adams}, {Form::ode, Method::bdf}, {Form::ggl, Method::bdf}};

/// What a method may lose against its tolerance. Tolerances bound the error of a step; over some hundred steps of a Runge-Kutta
/// pair or Adams two to three digits go, over some thousand steps of a BDF method, whose coefficients of error are larger
/// and whose Newton iteration ends at the tolerance, four and more.
double loss(Method method) {
  return method == Method::bdf ? 5e4 : 5e2;
}

double error(const State& a, const State& b) {
  return std::max((a.q - b.q).cwiseAbs().maxCoeff(), (a.v - b.v).cwiseAbs().maxCoeff());
}

/// Slope of log(error) over log(tolerance) by least squares.
double tolerance_slope(const Built& m, double duration, const Scheme& scheme, const State& exact) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (double tolerance = 1e-5; tolerance > 0.5e-10; tolerance /= std::sqrt(10.0)) {
    const Trajectory run =
        simulate(m.system, m.state, duration, duration, tolerance, scheme.method, scheme.form);
    const double x = std::log10(tolerance), y = std::log10(error(run.last(), exact));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// A double pendulum in space: two bodies on spherical joints, smooth and not too wild for a second.
Built spatial_pendulum() {
  SystemBuilder b;
  b.gravity = {0, 0, -9.81};
  const int upper = b.add_body("upper", 2, diagonal(0.1, 0.2, 0.25), {Matrix3::Identity(), {0.5, 0, 0}});
  const int lower = b.add_body("lower", 1, diagonal(0.05, 0.1, 0.07), {Matrix3::Identity(), {1, 0.5, 0}});
  b.add_joint("shoulder", {}, upper, {0, 0, 0}, SphericalJoint{});
  b.add_joint("elbow", {upper}, lower, {1, 0, 0}, SphericalJoint{});
  Built m = build(std::move(b));
  m.state.v << 0.5, -0.3, 1, 0.2, 0.8, -0.4;
  return m;
}

TEST(Integration, ErrorsOfOpenTreesFollowTheTolerance) {
  const Built m = spatial_pendulum();
  const State exact = simulate(m.system, m.state, 1.0, 1.0, 1e-13, Method::erk).last();
  for (const Scheme& scheme : kOpenSchemes) {
    const double slope = tolerance_slope(m, 1.0, scheme, exact);
    EXPECT_GT(slope, 0.7) << name(scheme);
    EXPECT_LT(slope, 1.3) << name(scheme);
  }
}

TEST(Integration, ErrorsOfClosedLoopsFollowTheTolerance) {
  Built m = four_bar(SphericalClosure{}, 6.0);
  assembled(m);
  const State exact = simulate(m.system, m.state, 1.0, 1.0, 1e-13, Method::erk).last();
  for (const Scheme& scheme : kClosedSchemes) {
    const double slope = tolerance_slope(m, 1.0, scheme, exact);
    EXPECT_GT(slope, 0.7) << name(scheme);
    EXPECT_LT(slope, 1.3) << name(scheme);
  }
}

TEST(Integration, FormsAgreeOnAClosedLoopAndKeepItClosed) {
  Built m = four_bar(RevoluteClosure{}, 6.0);
  assembled(m);
  const Trajectory exact = simulate(m.system, m.state, 2.0, 0.02, 1e-12, Method::erk);
  for (const Scheme& scheme : kClosedSchemes) {
    const Trajectory run = simulate(m.system, m.state, 2.0, 0.02, 1e-9, scheme.method, scheme.form);
    ASSERT_EQ(run.states.size(), exact.states.size()) << run.summary.message;
    Workspace ws(m.system);
    double worst = 0;
    for (std::size_t i = 0; i < run.states.size(); ++i) {
      worst = std::max(worst, error(run.states[i], exact.states[i]));
      update_state(m.system, run.states[i], ws);
      EXPECT_LE(ws.Phi.cwiseAbs().maxCoeff(), 1e-10) << name(scheme) << " t = " << run.states[i].t;
      EXPECT_LE(ws.Phi_rate.cwiseAbs().maxCoeff(), 1e-10) << name(scheme) << " t = " << run.states[i].t;
    }
    EXPECT_LT(worst, loss(scheme.method) * 1e-9) << name(scheme);
  }
}

TEST(Integration, AFourBarAmongManyMovesAsItDoesAlone) {
  // alone its Jacobian is held dense, among many sparse
  Built alone = four_bar(RevoluteClosure{}, 6.0);
  const Trajectory one = simulate(alone.system, alone.state, 1.0, 0.1, 1e-9, Method::bdf, Form::ggl);
  const int count = 12;
  const Built many = testing::four_bars(count, RevoluteClosure{}, 6.0);
  const Trajectory all = simulate(many.system, many.state, 1.0, 0.1, 1e-9, Method::bdf, Form::ggl);
  ASSERT_EQ(all.summary.status, TransientSummary::Status::complete) << all.summary.message;
  ASSERT_EQ(all.states.size(), one.states.size());
  for (std::size_t i = 0; i < one.states.size(); ++i)
    for (int k = 0; k < count; ++k) {
      const State share{
          one.states[i].t, all.states[i].q.segment(3 * k, 3), all.states[i].v.segment(3 * k, 3), {}};
      EXPECT_LT(error(share, one.states[i]), loss(Method::bdf) * 1e-9) << "t = " << share.t;
    }
}

/// A mass on a spring whose other end is moved by two smooth steps; u'' + w^2 u = w^2 s(t).
struct DrivenOscillator {
  static constexpr double mass = 2, k = 50, c = 3, l0 = 1;
  static Built make() {
    SystemBuilder b;
    const int drive = b.add_body("drive", 1, diagonal(1, 1, 1), {});
    b.add_joint("push", {}, drive, {0, 0, 0},
                PrescribedJoint{PrescribedJoint::Kind::prismatic, Vector3::UnitX(),
                                Motion("push", 0, {{0.3, 0.05, 0.2}, {0.9, 0.1, -0.3}})});
    const int cart = b.add_body("cart", mass, diagonal(1, 1, 1), {Matrix3::Identity(), {l0, 0, 0}});
    b.add_joint("slide", {}, cart, {0, 0, 0}, PrismaticJoint{Vector3::UnitX()});
    b.add_force(SpringDamper("spring", b.add_marker({drive}), b.add_marker({cart}), k, c, l0));
    return build(std::move(b));
  }
  static double step(double t, double time, double duration, double change, double* rate) {
    const double u = std::clamp((t - time) / duration, 0.0, 1.0);
    *rate += change * 30 * u * u * (u - 1) * (u - 1) / duration;
    return change * u * u * u * (6 * u * u - 15 * u + 10);
  }
  /// x and x' by Runge-Kutta steps that meet the edges of the motion.
  static std::pair<double, double> exact(double duration) {
    const auto f = [](double t, double x, double v) {
      double rate = 0;
      const double s = step(t, 0.3, 0.05, 0.2, &rate) + step(t, 0.9, 0.1, -0.3, &rate);
      return -(k * (x - s) + c * (v - rate)) / mass;
    };
    double x = 0, v = 0;
    const double h = 1e-4;
    for (int i = 0; i < std::lround(duration / h); ++i) {
      const double t = i * h;
      const double a1 = f(t, x, v), v2 = v + h / 2 * a1;
      const double a2 = f(t + h / 2, x + h / 2 * v, v2), v3 = v + h / 2 * a2;
      const double a3 = f(t + h / 2, x + h / 2 * v2, v3), v4 = v + h * a3;
      const double a4 = f(t + h, x + h * v3, v4);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return {x, v};
  }
};

TEST(Integration, LosesNothingAtTheEdgesOfPrescribedMotions) {
  const Built m = DrivenOscillator::make();
  const auto [x, v] = DrivenOscillator::exact(1.5);
  for (const Scheme& scheme : kOpenSchemes) {
    const Trajectory run = simulate(m.system, m.state, 1.5, 0.5, 1e-9, scheme.method, scheme.form);
    EXPECT_EQ(run.summary.restarts, 4) << name(scheme);
    EXPECT_NEAR(run.last().q[0], x, 1e-7) << name(scheme);
    EXPECT_NEAR(run.last().v[0], v, 1e-7) << name(scheme);
    EXPECT_NEAR(energy_balance(m.system, run.last(), run.work.back()), 0, loss(scheme.method) * 1e-9)
        << name(scheme);
  }
}

TEST(Integration, RepeatsItselfToTheLastBit) {
  Built loop = four_bar(RevoluteClosure{}, 6.0);
  for (const Scheme& scheme : kClosedSchemes) {
    const Trajectory a = simulate(loop.system, loop.state, 1.0, 0.1, 1e-8, scheme.method, scheme.form);
    const Trajectory b = simulate(loop.system, loop.state, 1.0, 0.1, 1e-8, scheme.method, scheme.form);
    ASSERT_EQ(a.states.size(), b.states.size());
    for (std::size_t i = 0; i < a.states.size(); ++i) {
      EXPECT_EQ(a.states[i].q, b.states[i].q) << name(scheme);
      EXPECT_EQ(a.states[i].v, b.states[i].v) << name(scheme);
    }
  }
}

}  // namespace
}  // namespace wishbone
