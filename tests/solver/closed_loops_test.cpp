// Closed loops against planar formulations written here and against published benchmarks.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"
#include "solver/reactions.h"

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

/// How a closed loop may be integrated.
struct Scheme {
  Form form;
  Method method;
};
constexpr Scheme kSchemes[] = {
    {Form::index1, Method::erk}, {Form::index1, Method::bdf}, {Form::ggl, Method::bdf}};

std::string name(const Scheme& s) {
  return std::string(to_string(s.form)) + " " + to_string(s.method);
}

/// y'' = f(y, y') by the classical Runge-Kutta method in small steps.
struct Motion1 {
  double y, rate;
};
Motion1 integrate(const std::function<double(double, double)>& f, Motion1 m, double duration, int steps) {
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const auto slope = [&](double y, double r) { return std::pair(r, f(y, r)); };
    const auto [a1, b1] = slope(m.y, m.rate);
    const auto [a2, b2] = slope(m.y + h / 2 * a1, m.rate + h / 2 * b1);
    const auto [a3, b3] = slope(m.y + h / 2 * a2, m.rate + h / 2 * b2);
    const auto [a4, b4] = slope(m.y + h * a3, m.rate + h * b3);
    m.y += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    m.rate += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
  }
  return m;
}

/// The four-bar of mechanisms.h as a planar linkage of one coordinate, the crank angle:
/// I(th) th'' + I'(th)/2 th'^2 + V'(th) = 0.
struct PlanarFourBar {
  static constexpr double a = 1, b = 3, c = 2.5, d = 3, g = 9.81;

  struct Angles {
    double coupler, rocker;
  };
  static Angles angles(double th) {
    const double x = d - a * std::cos(th), y = -a * std::sin(th);  // from B to D
    const double s = std::hypot(x, y), line = std::atan2(y, x);
    const double coupler = line + std::acos((b * b + s * s - c * c) / (2 * b * s));
    return {coupler, std::atan2(b * std::sin(coupler) - y, b * std::cos(coupler) - x)};
  }
  /// Twice the kinetic energy at th' = 1; rods of 1 kg/m.
  static double inertia(double th) {
    const auto [phi, psi] = angles(th);
    // velocity loop: a th' e(th) + b phi' e(phi) = c psi' e(psi), e normal to the rods
    const double phi_rate = a * std::sin(psi - th) / (b * std::sin(phi - psi));
    const double psi_rate = a * std::sin(phi - th) / (c * std::sin(phi - psi));
    const double vx = -a * std::sin(th) - b / 2 * std::sin(phi) * phi_rate;
    const double vy = a * std::cos(th) + b / 2 * std::cos(phi) * phi_rate;
    return a * a * a / 3 + b * (vx * vx + vy * vy) + b * b * b / 12 * phi_rate * phi_rate +
           c * c * c / 3 * psi_rate * psi_rate;
  }
  static double potential(double th) {
    const auto [phi, psi] = angles(th);
    return g * (a * a / 2 * std::sin(th) + b * (a * std::sin(th) + b / 2 * std::sin(phi)) +
                c * c / 2 * std::sin(psi));
  }
  static double derivative(double (*f)(double), double x) {
    const double h = 2e-3;
    return (45 * (f(x + h) - f(x - h)) - 9 * (f(x + 2 * h) - f(x - 2 * h)) + f(x + 3 * h) - f(x - 3 * h)) /
           (60 * h);
  }
  static double acceleration(double th, double rate) {
    return -(derivative(inertia, th) / 2 * rate * rate + derivative(potential, th)) / inertia(th);
  }
};

TEST(FourBar, MovesLikeThePlanarLinkageWhateverTheCutJoint) {
  for (const auto& [cut, redundant] :
       {std::pair<CutJoint, std::vector<int>>{SphericalClosure{}, {2}}, {RevoluteClosure{}, {2, 3, 4}}})
    for (const Scheme& scheme : kSchemes) {
      Built m = four_bar(cut, 6.0);
      assembled(m);
      const Trajectory run = simulate(m.system, m.state, 2.0, 0.5, 1e-9, scheme.method, scheme.form);
      ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
      EXPECT_EQ(run.summary.assembly.redundant_rows, redundant);
      for (const State& s : run.states) {
        const Motion1 exact = integrate(PlanarFourBar::acceleration, {M_PI / 3, m.state.v[0]}, s.t,
                                        static_cast<int>(4000 * s.t));
        EXPECT_NEAR(s.q[0] + M_PI / 3, exact.y, 1e-6) << name(scheme) << " t = " << s.t;
        EXPECT_NEAR(s.v[0], exact.rate, 1e-5) << name(scheme) << " t = " << s.t;
      }
    }
}

TEST(FourBar, ParallelogramOfA02FollowsItsPendulum) {
  // reference: IFToMM A02 with N = 1, closed form psi'' = -11.772 sin psi, psi = theta + pi/2, up to its first singular
  // position (theta = 0, at about 0.71 s)
  const double length = 1, J = 1.0 / 12;
  const auto rod = [&](SystemBuilder& b, const char* name, const Vector3& from, const Vector3& to) {
    return b.add_body(name, 1.0, diagonal(J, J, J), {Matrix3::Identity(), (from + to) / 2});
  };
  const Vector3 A0(0, 0, 0), A1(length, 0, 0), B0(0, length, 0), B1(length, length, 0);
  SystemBuilder b;
  b.gravity = {0, -9.81, 0};
  const int left = rod(b, "left crank", A0, B0), right = rod(b, "right crank", A1, B1);
  const int coupler = rod(b, "coupler", B0, B1);
  b.add_joint("A0", {}, left, A0, RevoluteJoint{}, 0, -1);
  b.add_joint("A1", {}, right, A1, RevoluteJoint{}, 0, -1);
  b.add_joint("B0", {left}, coupler, B0, RevoluteJoint{}, 0, 1);
  b.add_closure("B1", b.add_marker({coupler}, B1), b.add_marker({right}, B1), RevoluteClosure{});
  const Built m = build(std::move(b));
  for (const Scheme& scheme : kSchemes) {
    const Trajectory run = simulate(m.system, m.state, 0.6, 0.1, 1e-9, scheme.method, scheme.form);
    ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
    for (const State& s : run.states) {
      const Motion1 exact = integrate([](double psi, double) { return -11.772 * std::sin(psi); }, {M_PI, -1},
                                      s.t, static_cast<int>(10000 * s.t));
      EXPECT_NEAR(s.q[0], exact.y - M_PI, 1e-7) << name(scheme) << " t = " << s.t;
      EXPECT_NEAR(s.v[0], exact.rate, 1e-6) << name(scheme) << " t = " << s.t;
    }
  }
}

/// IFToMM A04: five bars of 1 m and 1 kg, square section 0.1 m, six revolute joints, the last one cut.
Built bricard() {
  const Vector3 P[] = {{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
  const Vector3 axis[] = {Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX(),
                          Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX()};
  const double w = 0.1, across = (1 + w * w) / 12, along = w * w / 6;
  SystemBuilder b;
  b.gravity = {0, -9.81, 0};
  int parent = SystemBuilder::kGround;
  for (int i = 0; i < 5; ++i) {
    const Vector3 u = P[i + 1] - P[i];
    const Matrix3 J = across * Matrix3::Identity() + (along - across) * u * u.transpose();
    const int bar =
        b.add_body("bar " + std::to_string(i + 1), 1.0, J, {Matrix3::Identity(), (P[i] + P[i + 1]) / 2});
    b.add_joint("P" + std::to_string(i), {parent}, bar, P[i], RevoluteJoint{axis[i]});
    parent = bar;
  }
  Matrix3 R_WM;  // z along the axis x
  R_WM << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  b.add_closure("P5", b.add_marker({parent}, P[5], R_WM), b.add_marker({}, P[5], R_WM), RevoluteClosure{});
  b.add_marker({2}, P[3]);
  return build(std::move(b));
}

TEST(Bricard, IsFoundToHaveOneRedundantRowAndFollowsA04) {
  const Built m = bricard();
  struct Sample {
    int t;
    Vector3 P3;
  };
  const Sample samples[] = {{1, {5.1050146118721974e-01, -1.6491675993948063e+00, 1.4012311455318583e-01}},
                            {2, {-9.6934034477765160e-01, -1.2212468949563174e+00, 7.5427801077977673e-01}},
                            {3, {-9.6719980004868971e-01, -1.2280202146742363e+00, 7.4598317617572129e-01}}};
  for (const Scheme& scheme : kSchemes) {
    const Trajectory run = simulate(m.system, m.state, 3.0, 1.0, 1e-10, scheme.method, scheme.form);
    ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
    EXPECT_EQ(run.summary.assembly.redundant_rows.size(), 1u);
    Workspace ws(m.system);
    for (const auto& [t, P3] : samples) {
      update_state(m.system, run.states[t], ws);
      EXPECT_LT((ws.markers.back().p_WM - P3).norm(), 1e-7) << name(scheme) << " t = " << t;
      EXPECT_NEAR(energy_balance(m.system, run.states[t], {}), -29.43, 1e-7) << name(scheme) << " t = " << t;
    }
  }
}

TEST(Reactions, OfABeamThatIsClampedAtBothEndsAreSharedEvenly) {
  // all six rows of the second clamp are redundant; of the least norm are half the weight each and no moments
  const double weight = 2 * 9.81;
  SystemBuilder b;
  b.gravity = {0, -9.81, 0};
  const int beam = b.add_body("beam", 2, diagonal(1, 1, 1), {});
  const Vector3 left(-1, 0, 0), right(1, 0, 0);
  b.add_joint("left", {}, beam, left, FixedJoint{});
  b.add_closure("right", b.add_marker({}, right), b.add_marker({beam}, right), FixedClosure{});
  Built m = build(std::move(b));
  Workspace ws = assembled(m);
  EXPECT_TRUE(ws.closure.kept.empty());
  calc_forward_dynamics(m.system, m.state, ws);
  calc_reactions(m.system, ws);
  Vector6 half_weight = Vector6::Zero();
  half_weight[4] = -weight / 2;
  EXPECT_LT((tree_joint_reaction(m.system, ws, 0) - half_weight).norm(), 1e-12 * weight);
  EXPECT_LT((closure_wrench<double>(m.system.closures[0], 0, ws.lambda, ws) - half_weight).norm(),
            1e-12 * weight);
}

TEST(Reactions, OfATriangleOfRodsAreThoseOfStatics) {
  // two massless-in-effect rods (no gravity) from the ground at (-1, 0) and (1, 0) meet at the apex (0, 2), loaded by F;
  // each carries F/(2 cos alpha) along itself
  const double F = 700, length = std::sqrt(5.0), cos_alpha = 2 / length;
  const Vector3 left_foot(-1, 0, 0), right_foot(1, 0, 0), apex(0, 2, 0);
  SystemBuilder b;
  const int left = b.add_body("left", 1, diagonal(1, 1, 1), {Matrix3::Identity(), (left_foot + apex) / 2});
  const int right = b.add_body("right", 1, diagonal(1, 1, 1), {Matrix3::Identity(), (right_foot + apex) / 2});
  b.add_joint("left foot", {}, left, left_foot, RevoluteJoint{});
  b.add_joint("right foot", {}, right, right_foot, RevoluteJoint{});
  const MarkerIndex A = b.add_marker({left}, apex), B = b.add_marker({right}, apex);
  b.add_closure("apex", A, B, SphericalClosure{});
  b.add_force(AppliedLoad("load", A, {Vector3::Zero(), {0, -F, 0}}));
  Built m = build(std::move(b));
  Workspace ws = assembled(m);
  EXPECT_EQ(ws.closure.kept, (std::vector<int>{0, 1}));
  calc_forward_dynamics(m.system, m.state, ws);
  calc_joint_forces(m.system, ws);
  EXPECT_LT(ws.v_rate.norm(), 1e-12 * F);

  // on the first-named body: the right rod pushes the left one's tip from its foot
  const Vector6 on_left = closure_wrench<double>(m.system.closures[0], 0, ws.lambda, ws);
  const Vector3 push = F / (2 * cos_alpha) * (apex - right_foot) / length;
  EXPECT_LT((on_left.tail<3>() - push).norm(), 1e-12 * F);
  EXPECT_LT(on_left.head<3>().norm(), 1e-12 * F);
  EXPECT_LT((closure_wrench<double>(m.system.closures[0], 1, ws.lambda, ws) + on_left).norm(), 1e-12 * F);
  // the ground holds each rod along itself
  EXPECT_LT((ws.bodies[right].F_joint.tail<3>() - push).norm(), 1e-12 * F);
  EXPECT_LT((ws.bodies[left].F_joint.tail<3>() - Vector3(-push.x(), push.y(), 0)).norm(), 1e-12 * F);
}

}  // namespace
}  // namespace wishbone
