#include "joints/motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "core/jet2.h"

namespace wishbone {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

// One degree to the left for a quarter of a second.
std::vector<MotionStep> impulse() {
  return {{0.30, 0.02, 1 * kDegree}, {0.55, 0.02, -1 * kDegree}};
}

Ackermann geometry(Ackermann::Side side) {
  return {2.4, 1.2, side};
}

// Central differences of eighth order.
template <class F>
double derivative(F f, double t, double h) {
  return (4.0 / 5 * (f(t + h) - f(t - h)) - 1.0 / 5 * (f(t + 2 * h) - f(t - 2 * h)) +
          4.0 / 105 * (f(t + 3 * h) - f(t - 3 * h)) - 1.0 / 280 * (f(t + 4 * h) - f(t - 4 * h))) /
         h;
}

TEST(Motion, GoesFromStartThroughEachStep) {
  const Motion motion("steering", 0.5, {{1.0, 2.0, 3.0}, {4.0, 1.0, -1.0}});
  EXPECT_DOUBLE_EQ(motion.at(-10).position, 0.5);
  EXPECT_DOUBLE_EQ(motion.at(1.0).position, 0.5);
  EXPECT_DOUBLE_EQ(motion.at(2.0).position, 0.5 + 1.5);  // s(1/2) = 1/2
  EXPECT_DOUBLE_EQ(motion.at(3.5).position, 3.5);
  EXPECT_DOUBLE_EQ(motion.at(99).position, 2.5);
  EXPECT_DOUBLE_EQ(motion.at(2.0).rate, 15.0 / 8 * 3.0 / 2.0);  // s'(1/2) = 15/8
  EXPECT_DOUBLE_EQ(motion.at(2.0).acceleration, 0);
}

TEST(Motion, DerivativesAreExact) {
  for (const auto& ackermann : {std::optional<Ackermann>(), std::optional(geometry(Ackermann::Side::kLeft)),
                                std::optional(geometry(Ackermann::Side::kRight))}) {
    // overlapping large steps, so that the Ackermann map is strongly curved
    const Motion motion("steering", 0.1, {{0.0, 1.0, 0.4}, {0.3, 1.0, -0.9}}, ackermann);
    for (double t = 0.32; t < 0.99; t += 0.01) {
      const double rate = derivative([&](double s) { return motion.at(s).position; }, t, 4e-3);
      const double acceleration = derivative([&](double s) { return motion.at(s).rate; }, t, 4e-3);
      EXPECT_NEAR(motion.at(t).rate, rate, 1e-11);
      EXPECT_NEAR(motion.at(t).acceleration, acceleration, 1e-9);
    }
  }
}

TEST(Motion, IsTwiceContinuouslyDifferentiableAtTheEdges) {
  const Motion motion("steering", 0, impulse(), geometry(Ackermann::Side::kLeft));
  const double largest = 5.8 * kDegree / (0.02 * 0.02);  // of the acceleration
  for (const double edge : motion.stop_times()) {
    const MotionValue before = motion.at(edge - 1e-10), after = motion.at(edge + 1e-10);
    EXPECT_NEAR(before.position, after.position, 1e-15);
    EXPECT_NEAR(before.rate, 0, 1e-10);
    EXPECT_NEAR(after.rate, 0, 1e-10);
    EXPECT_NEAR(before.acceleration, 0, 1e-6 * largest);
    EXPECT_NEAR(after.acceleration, 0, 1e-6 * largest);
  }
}

TEST(Motion, StopsAtEveryEdgeOnce) {
  // 0.1 + 0.2 is not 0.3 in binary, but one edge all the same
  const Motion motion("steering", 0, {{0.3, 0.1, 1.0}, {0.1, 0.2, 1.0}, {0.1, 0.5, 1.0}});
  EXPECT_THAT(motion.stop_times(), ::testing::Pointwise(::testing::DoubleNear(1e-15), {0.1, 0.3, 0.4, 0.6}));
  EXPECT_THAT(Motion("steering", 1, {}).stop_times(), ::testing::IsEmpty());
}

TEST(Motion, AckermannWheelsTurnAboutOnePoint) {
  const Motion left("steering", 0, {{0, 1, 0.3}}, geometry(Ackermann::Side::kLeft));
  const Motion right("steering", 0, {{0, 1, 0.3}}, geometry(Ackermann::Side::kRight));
  for (double t = 0.05; t < 1.5; t += 0.05) {
    const double l = left.at(t).position, r = right.at(t).position;
    EXPECT_NEAR(1 / std::tan(r) - 1 / std::tan(l), 1.2 / 2.4, 1e-9 / std::tan(r));
    EXPECT_GT(l, r);  // turning left, the left wheel is the inner one
  }
}

TEST(Motion, AckermannIsMirrorSymmetric) {
  const Motion left("steering", 0, {{0, 1, 0.3}}, geometry(Ackermann::Side::kLeft));
  const Motion right("steering", 0, {{0, 1, -0.3}}, geometry(Ackermann::Side::kRight));
  for (const double t : {0.2, 0.5, 2.0}) {
    EXPECT_DOUBLE_EQ(left.at(t).position, -right.at(t).position);
    EXPECT_DOUBLE_EQ(left.at(t).acceleration, -right.at(t).acceleration);
  }
}

TEST(Motion, RejectsWhatItCannotFollow) {
  EXPECT_THROW(Motion("steering", 0, {{0, 0, 1}}), InputError);
  // atan(2 l/w) = 76 deg: there the inner wheel would stand across
  EXPECT_NO_THROW(Motion("steering", 0, {{0, 1, 75 * kDegree}}, geometry(Ackermann::Side::kLeft)));
  try {
    Motion("steering", 0, {{0, 1, 77 * kDegree}}, geometry(Ackermann::Side::kLeft));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("steering: error: the steering command"));
  }
}

Function expression(const std::string& text) {
  return Function(Expression(text, {"t"}));
}

Table sampled_sine(Table::Interpolation interpolation) {
  std::vector<double> t, y;
  for (int i = 0; i <= 200; ++i) {
    t.push_back(0.01 * i);
    y.push_back(0.2 * std::sin(3 * t.back()));
  }
  return {"table", t, y, interpolation};
}

TEST(Motion, FollowsAnExpressionWithExactDerivatives) {
  const Motion motion("drive", expression("0.5*sin(4*t) + t^2"));
  for (const double t : {0.0, 0.3, 2.0}) {
    EXPECT_NEAR(motion.at(t).position, 0.5 * std::sin(4 * t) + t * t, 1e-15);
    EXPECT_NEAR(motion.at(t).rate, 2 * std::cos(4 * t) + 2 * t, 1e-14);
    EXPECT_NEAR(motion.at(t).acceleration, -8 * std::sin(4 * t) + 2, 1e-14);
  }
}

TEST(Motion, OfAnExpressionWithStepsIsTheMotionOfSteps) {
  const auto ackermann = geometry(Ackermann::Side::kRight);
  const Motion steps("steering", 0.1, {{0.2, 0.5, 0.3}, {0.4, 0.2, -0.1}}, ackermann);
  const Motion same("steering", expression("0.1 + step(t, 0.2, 0, 0.7, 0.3) - step(t, 0.4, 0, 0.6, 0.1)"),
                    ackermann);
  for (double t = 0; t < 1; t += 0.03) {
    EXPECT_NEAR(same.at(t).position, steps.at(t).position, 1e-15);
    EXPECT_NEAR(same.at(t).rate, steps.at(t).rate, 1e-13);
    EXPECT_NEAR(same.at(t).acceleration, steps.at(t).acceleration, 1e-11);
  }
  EXPECT_THAT(same.stop_times(), ::testing::Pointwise(::testing::DoubleNear(1e-15), steps.stop_times()));
}

TEST(Motion, FollowsASplineThroughMeasuredPoints) {
  const Motion motion("steering", Function(sampled_sine(Table::Interpolation::spline)));
  for (double t = 0; t <= 2; t += 0.0173) {
    EXPECT_NEAR(motion.at(t).position, 0.2 * std::sin(3 * t), 1e-8);
    EXPECT_NEAR(motion.at(t).rate, 0.6 * std::cos(3 * t), 2e-6);
    EXPECT_NEAR(motion.at(t).acceleration, -1.8 * std::sin(3 * t), 1e-3);
  }
  EXPECT_THAT(motion.stop_times(), ::testing::IsEmpty());
  EXPECT_NO_THROW(motion.at(std::nextafter(2, 3)));
}

TEST(Motion, RejectsATableThatHasNoAcceleration) {
  try {
    Motion("steering", Function(sampled_sine(Table::Interpolation::linear)));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "steering: error: a linear table has no acceleration at its points (got 0)\n"
                 "  interpolate it by a spline, or write a motion of steps");
  }
}

TEST(Motion, RejectsFunctionsOfMoreThanTheTime) {
  EXPECT_THROW(Motion("steering", Function(Expression("t + gap", {"t", "gap"}))), InputError);
}

TEST(Motion, FailsInWordsWhereItIsUndefined) {
  const auto message = [](const Motion& motion, double t) {
    try {
      motion.at(t);
    } catch (const NumericsError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(Motion("drive", expression("1/(t - 1)")), 1),
            "drive at t = 1 s: error: the motion has no value, rate or acceleration (got inf)\n"
            "  look for a root of zero, a division by zero, an overflow or a jump in its expression");
  EXPECT_NE(message(Motion("drive", expression("sqrt(t)")), 0), "");
  EXPECT_EQ(message(Motion("drive", Function(sampled_sine(Table::Interpolation::spline))), 3),
            "drive at t = 3 s: error: the table of the motion does not reach this time (got 2)\n"
            "  give points for the whole run: at an end the motion need not rest");
  EXPECT_NE(message(Motion("drive", expression("t"), geometry(Ackermann::Side::kLeft)), 1.4), "");
}

TEST(Jet2, KnowsTheRulesOfCalculus) {
  const Jet2 x = Jet2::variable(0.7);
  const Jet2 cubic = x * x * x - 2.0 * x;
  EXPECT_DOUBLE_EQ(cubic.d1, 3 * 0.49 - 2);
  EXPECT_DOUBLE_EQ(cubic.d2, 6 * 0.7);
  const Jet2 same = atan(tan(x));  // the identity
  EXPECT_NEAR(same.value, 0.7, 1e-15);
  EXPECT_NEAR(same.d1, 1, 1e-15);
  EXPECT_NEAR(same.d2, 0, 1e-15);
  const Jet2 one = (cubic / x + 2.0) / (x * x);
  EXPECT_NEAR(one.value, 1, 1e-15);
  EXPECT_NEAR(one.d1, 0, 1e-14);
  EXPECT_NEAR(one.d2, 0, 1e-13);
}

}  // namespace
}  // namespace wishbone
