#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/dual.h"
#include "forces/joint_friction.h"
#include "forces/joint_limit.h"
#include "forces/joint_spring.h"
#include "forces/support.h"

namespace wishbone {
namespace {

using testing::Applied;
using ::testing::HasSubstr;
using testing::message_of;
using testing::Random;
using testing::rotation;
using ::testing::StartsWith;

constexpr Gauge kAngle{Gauge::Kind::rotation};
constexpr Gauge kTravel{Gauge::Kind::translation, 1};

/// Markers 0 and 1 with the angle u and the rate u' about z of the first, which is anywhere in any motion.
template <class T>
std::vector<MarkerStateT<T>> turned(const T& u, const T& rate, unsigned seed = 1) {
  Random random(seed);
  std::vector<MarkerStateT<T>> markers(2);
  for (MarkerStateT<T>& m : markers) {
    m.p_WM = random.vector(1).cast<T>();
    m.v_WM = random.vector(2).cast<T>();
  }
  markers[0].R_WM = rotation(random.vector(1), random.uniform(-3, 3)).cast<T>();
  markers[0].w_WM = random.vector(2).cast<T>();
  markers[1].R_WM = markers[0].R_WM * rotation_about(Vector3::UnitZ(), u);
  markers[1].w_WM = markers[0].w_WM + markers[0].R_WM.col(2) * rate;
  return markers;
}

template <class Element>
JointForceOutput reading(const Element& element, double u, double rate) {
  const std::vector<MarkerState> markers = turned(u, rate);
  return element.output({0.0, markers, {}, 0, u});
}

template <class Element>
Applied applied_at(const Element& element, double u, double rate, unsigned seed = 1) {
  const std::vector<MarkerState> markers = turned(u, rate, seed);
  Applied result;
  result.wrenches.resize(2);
  ForceOutput output{result.wrenches, {}};
  element.apply({0.0, markers, {}, 0, u}, output);
  result.power = output.power;
  return result;
}

/// dE/dt of the energy stored at u, moving at u'.
template <class Element>
double energy_rate(const Element& element, double u, double rate) {
  const auto energy = [&](double at) {
    const std::vector<MarkerState> markers = turned(at, 0.0);
    return element.energy({0.0, markers, {}, 0, at});
  };
  const double h = 1e-5;
  return (energy(u + h) - energy(u - h)) / (2 * h) * rate;
}

/// f with its derivatives by u and by u', first and second direction.
template <class Element>
Dual differentiated(const Element& element, double u, double rate) {
  Dual u_dual(u), rate_dual(rate);
  u_dual.d[0] = 1;
  rate_dual.d[1] = 1;
  const auto markers = turned(u_dual, rate_dual);
  std::vector<WrenchT<Dual>> wrenches(2);
  ForceOutputT<Dual> output{wrenches, {}};
  element.apply(ForceInputT<Dual>{0.0, markers, {}, 0, u}, output);
  return markers[0].R_WM.col(2).dot(wrenches[1].t);
}

TEST(JointSpring, TorsionSpringTurnsBackThroughWholeTurns) {
  const JointSpring spring("spring", 0, 1, kAngle, 20, 3, 0.5);
  const double u = 4 * std::numbers::pi + 0.7;
  const JointForceOutput out = reading(spring, u, 1.5);
  EXPECT_NEAR(out.value, u, 1e-14);
  EXPECT_NEAR(out.rate, 1.5, 1e-14);
  EXPECT_NEAR(out.force, -(20 * (u - 0.5) + 3 * 1.5), 1e-12);
  const std::vector<MarkerState> markers = turned(u, 0.0);
  EXPECT_NEAR(spring.energy({0.0, markers, {}, 0, u}), 10 * (u - 0.5) * (u - 0.5), 1e-12);
  EXPECT_NEAR(spring.angle({0.0, markers, {}, 0, u - 2}), u, 1e-14);
}

TEST(JointSpring, TravelSpringPushesAlongItsAxis) {
  const JointSpring spring("spring", 0, 1, kTravel, 100, 10, 0.2);
  std::vector<MarkerState> markers(2);
  markers[1].p_WM = Vector3(3, 0.1, 0);
  markers[1].v_WM = Vector3(5, -0.3, 0);
  const JointForceOutput out = spring.output({0.0, markers, {}, 0});
  EXPECT_NEAR(out.force, 100 * 0.1 + 10 * 0.3, 1e-14);
  const Applied a = testing::applied(spring, markers);
  EXPECT_LT((a.wrenches[1].f - Vector3(0, 13, 0)).norm(), 1e-13);
  EXPECT_LT((a.wrenches[0].f + Vector3(0, 13, 0)).norm(), 1e-13);
  // about the origin of A the pair has no moment
  EXPECT_LT((a.wrenches[0].t + markers[1].p_WM.cross(a.wrenches[1].f)).norm(), 1e-13);
}

TEST(JointForce, ItsPowerIsThatOfItsWrenches) {
  for (unsigned seed = 1; seed < 30; ++seed) {
    const JointSpring spring("spring", 0, 1, kAngle, 20, 3, 0.5);
    const std::vector<MarkerState> markers = turned(1.2, -2.0, seed);
    const Applied a = applied_at(spring, 1.2, -2.0, seed);
    double power = 0;
    for (int i : {0, 1}) power += a.wrenches[i].f.dot(markers[i].v_WM) + a.wrenches[i].t.dot(markers[i].w_WM);
    EXPECT_NEAR(a.power, power, 1e-12);
    EXPECT_NEAR(a.power, reading(spring, 1.2, -2.0).force * -2.0, 1e-12);
    EXPECT_LT((a.wrenches[0].t + a.wrenches[1].t).norm(), 1e-13);
  }
}

TEST(JointForce, WhatTheEnergyDoesNotTakeIsDissipated) {
  const double k = 50, c = 2, n = 1.5, beta = 0.4;
  const JointSpring spring("spring", 0, 1, kAngle, k, c, 0.5);
  const JointFriction friction("friction", 0, 1, kAngle, 3, 0.01, c, StribeckPeak{5, 0.1});
  const JointLimit limit("limit", 0, 1, kAngle, -0.5, 1, {k, n, beta});
  for (double u = -1.4; u < 2; u += 0.23)
    for (const double rate : {-2.0, -0.05, 0.01, 0.7, 2.4}) {
      EXPECT_NEAR(applied_at(spring, u, rate).power + energy_rate(spring, u, rate), -c * rate * rate, 1e-7);
      EXPECT_LT(applied_at(friction, u, rate).power, -c * rate * rate);
      const double depth = std::max({-0.5 - u, u - 1, 0.0});
      const double loss = -k * std::pow(depth, n) * beta * rate * rate;
      EXPECT_NEAR(applied_at(limit, u, rate).power + energy_rate(limit, u, rate), loss, 1e-7);
    }
}

TEST(JointFriction, FallsFromThePeakToTheSlidingValue) {
  const JointFriction friction("friction", 0, 1, kAngle, 3, 0.001, 0, StribeckPeak{5, 0.1});
  EXPECT_EQ(reading(friction, 0.4, 0.0).force, 0);
  EXPECT_NEAR(reading(friction, 0.4, 0.1).force, -(3 + 2 * std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(reading(friction, 0.4, -10).force, 3, 1e-12);
}

TEST(JointFriction, WithoutAPeakIsCoulombsLawBeyondTheSmoothing) {
  const JointFriction friction("friction", 0, 1, kAngle, 3, 0.01, 0.5);
  EXPECT_NEAR(reading(friction, 0.4, 2).force, -(3 + 0.5 * 2), 1e-12);
  EXPECT_NEAR(reading(friction, 0.4, 0.01).force, -(3 * std::tanh(1.0) + 0.5 * 0.01), 1e-12);
}

TEST(JointLimit, PushesBackFromBothSidesOnly) {
  const JointLimit limit("limit", 0, 1, kAngle, -0.5, 1, {1000, 1.5, 0.3});
  EXPECT_EQ(reading(limit, 0.99, 5).force, 0);
  EXPECT_EQ(reading(limit, -0.49, -5).force, 0);
  EXPECT_NEAR(reading(limit, 1.04, 0).force, -1000 * 0.008, 1e-11);  // 0.04^1.5 = 0.008
  EXPECT_NEAR(reading(limit, -0.54, -2).force, 1000 * 0.008 * 1.6, 1e-11);
}

TEST(JointLimit, NeverPulls) {
  const JointLimit limit("limit", 0, 1, kAngle, -0.5, 1, {1000, 1.5, 0.3});
  EXPECT_EQ(reading(limit, 1.04, -4).force, 0);  // 1 + beta d' < 0
  EXPECT_EQ(reading(limit, -0.54, 4).force, 0);
}

TEST(JointLimit, MayHaveOneSide) {
  const JointLimit limit("limit", 0, 1, kAngle, std::nullopt, 1, {1000, 1, 0});
  EXPECT_EQ(reading(limit, -50, 0).force, 0);
  EXPECT_NEAR(reading(limit, 1.5, 0).force, -500, 1e-10);
}

TEST(JointForce, DerivativesByCoordinateAndRateAreExact) {
  const double u = 1.2, rate = 0.07;
  const Dual spring = differentiated(JointSpring("spring", 0, 1, kAngle, 20, 3, 0.5), u, rate);
  EXPECT_NEAR(spring.d[0], -20, 1e-12);
  EXPECT_NEAR(spring.d[1], -3, 1e-12);

  const Dual friction =
      differentiated(JointFriction("friction", 0, 1, kAngle, 3, 0.05, 0.5, StribeckPeak{5, 0.1}), u, rate);
  const double peak = 2 * std::exp(-0.49), tangent = std::tanh(1.4);
  EXPECT_NEAR(friction.d[0], 0, 1e-12);
  EXPECT_NEAR(friction.d[1],
              -(peak * -2 * rate / 0.01 * tangent + (3 + peak) * (1 - tangent * tangent) / 0.05 + 0.5),
              1e-11);

  const Dual limit = differentiated(JointLimit("limit", 0, 1, kAngle, -0.5, 1, {1000, 1.5, 0.3}), u, rate);
  EXPECT_NEAR(limit.d[0], -1500 * std::sqrt(0.2) * (1 + 0.3 * rate), 1e-9);
  EXPECT_NEAR(limit.d[1], -1000 * std::pow(0.2, 1.5) * 0.3, 1e-9);
}

TEST(JointForce, NamesItselfWhenADistanceIsLost) {
  const JointSpring spring("strut", 0, 1, {Gauge::Kind::distance}, 20, 3, 0.5);
  EXPECT_THAT(message_of<NumericsError>([&] { testing::applied(spring, std::vector<MarkerState>(2)); }),
              StartsWith("strut"));
}

TEST(JointForce, RejectsWrongDataByName) {
  const auto message = [](auto make) { return message_of<InputError>(make); };
  const Stop stop{1000, 1.5, 0.3};
  EXPECT_THAT(message([] { JointSpring("s", 0, 1, kAngle, -1, 0, 0); }),
              HasSubstr("s: error: the stiffness"));
  EXPECT_THAT(message([] { JointSpring("s", 0, 1, kAngle, 1, -1, 0); }), HasSubstr("the damping"));
  EXPECT_THAT(message([] { JointSpring("s", 2, 2, kAngle, 1, 0, 0); }), HasSubstr("different markers"));
  EXPECT_THAT(message([] { JointFriction("f", 0, 1, kAngle, -1, 1, 0); }), HasSubstr("the dry friction"));
  EXPECT_THAT(message([] { JointFriction("f", 0, 1, kAngle, 1, 0, 0); }),
              HasSubstr("the smoothing velocity"));
  EXPECT_THAT(message([] {
                JointFriction("f", 0, 1, kAngle, 3, 1, 0, StribeckPeak{2, 1});
              }),
              HasSubstr("friction at rest"));
  EXPECT_THAT(message([] {
                JointFriction("f", 0, 1, kAngle, 3, 1, 0, StribeckPeak{4, 0});
              }),
              HasSubstr("falls"));
  EXPECT_THAT(message([&] { JointLimit("l", 0, 1, kAngle, {}, {}, stop); }), HasSubstr("lower or an upper"));
  EXPECT_THAT(message([&] { JointLimit("l", 0, 1, kAngle, 2, 1, stop); }), HasSubstr("below the upper"));
  EXPECT_THAT(message([] { JointLimit("l", 0, 1, kAngle, 0, 1, {0, 1, 0}); }), HasSubstr("the stiffness"));
  EXPECT_THAT(message([] { JointLimit("l", 0, 1, kAngle, 0, 1, {1, 0.5, 0}); }), HasSubstr("the exponent"));
  EXPECT_THAT(message([] { JointLimit("l", 0, 1, kAngle, 0, 1, {1, 1, -1}); }), HasSubstr("the damping"));
}

}  // namespace
}  // namespace wishbone
