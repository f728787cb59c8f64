#include "core/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "allocation_counter.h"
#include "core/dual.h"
#include "core/error.h"
#include "core/function.h"
#include "core/jet2.h"
#include "text_files.h"

namespace wishbone {
namespace {

using Interpolation = Table::Interpolation;

std::vector<double> values(const std::vector<double>& x, double (*f)(double)) {
  std::vector<double> y;
  for (const double xi : x) y.push_back(f(xi));
  return y;
}

std::vector<double> even_points(double first, double last, int steps) {
  std::vector<double> x;
  for (int i = 0; i <= steps; ++i) x.push_back(first + (last - first) * i / steps);
  return x;
}

Jet2 jet_at(const Table& table, double x) {
  return table(Jet2::variable(x));
}

TEST(Table, GoesThroughItsPointsAndHoldsTheEnds) {
  const std::vector<double> x{-1, 0, 0.5, 3, 3.25}, y{2, -1, 4, 4, 0};
  for (const auto interpolation : {Interpolation::linear, Interpolation::spline}) {
    const Table table("table", x, y, interpolation);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(table(x[i]), y[i], 1e-14);
    EXPECT_EQ(table(-100.0), 2);
    EXPECT_EQ(table(100.0), 0);
    EXPECT_EQ(jet_at(table, -100).d1, 0);
    EXPECT_EQ(jet_at(table, 100).d2, 0);
  }
}

TEST(LinearTable, IsStraightBetweenItsPoints) {
  const Table table("table", {0, 1, 3}, {0, 5, 1}, Interpolation::linear);
  EXPECT_DOUBLE_EQ(table(0.25), 1.25);
  EXPECT_DOUBLE_EQ(table(2.5), 2);
  EXPECT_DOUBLE_EQ(jet_at(table, 2.5).d1, -2);
  EXPECT_EQ(jet_at(table, 2.5).d2, 0);
}

// A cubic is its own not-a-knot spline, whatever the points.
TEST(SplineTable, ReproducesCubics) {
  const std::vector<double> x{-1, -0.7, 0.1, 0.2, 1.3, 2};
  const Table table("table", x, values(x, [](double t) { return 2 * t * t * t - t * t + 3 * t - 5; }),
                    Interpolation::spline);
  for (double t = -0.99; t < 2; t += 0.07) {
    const Jet2 f = jet_at(table, t);
    EXPECT_NEAR(f.value, 2 * t * t * t - t * t + 3 * t - 5, 1e-13);
    EXPECT_NEAR(f.d1, 6 * t * t - 2 * t + 3, 1e-12);
    EXPECT_NEAR(f.d2, 12 * t - 2, 1e-11);
  }
}

TEST(SplineTable, OfTwoAndThreePointsIsALineAndAParabola) {
  const Table line("table", {1, 3}, {2, 8}, Interpolation::spline);
  EXPECT_DOUBLE_EQ(line(2.0), 5);
  EXPECT_DOUBLE_EQ(jet_at(line, 2).d1, 3);
  const Table parabola("table", {0, 1, 3}, {0, 1, 9}, Interpolation::spline);
  EXPECT_DOUBLE_EQ(parabola(2.0), 4);
  EXPECT_DOUBLE_EQ(jet_at(parabola, 0.5).d2, 2);
}

TEST(SplineTable, IsTwiceContinuouslyDifferentiableAtItsPoints) {
  const std::vector<double> x{0, 0.4, 1, 1.1, 2, 2.7}, y{0, 1, -1, 3, 0, 1};
  const Table table("table", x, y, Interpolation::spline);
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const Jet2 before = jet_at(table, std::nextafter(x[i], -9)), after = jet_at(table, x[i]);
    EXPECT_NEAR(before.value, after.value, 1e-12);
    EXPECT_NEAR(before.d1, after.d1, 1e-11);
    EXPECT_NEAR(before.d2, after.d2, 1e-9);
  }
}

// The error of the value is of fourth order in the distance of the points, up to the ends, that of the
// curvature of second.
TEST(SplineTable, ConvergesWithFourthOrder) {
  const auto error = [](int steps, bool of_curvature) {
    const std::vector<double> x = even_points(0, 2, steps);
    const Table table("table", x, values(x, [](double t) { return std::sin(3 * t); }), Interpolation::spline);
    double largest = 0;
    for (double t = 0; t <= 2; t += 0.00123) {
      const Jet2 f = jet_at(table, t);
      largest = std::max(
          largest, of_curvature ? std::abs(f.d2 + 9 * std::sin(3 * t)) : std::abs(f.value - std::sin(3 * t)));
    }
    return largest;
  };
  EXPECT_NEAR(std::log2(error(80, false) / error(160, false)), 4, 0.2);
  EXPECT_NEAR(std::log2(error(80, true) / error(160, true)), 2, 0.2);
}

TEST(Table, DerivativesOfBothKindsAgree) {
  for (const auto interpolation : {Interpolation::linear, Interpolation::spline}) {
    const Table table("table", {0, 0.4, 1, 1.1, 2}, {0, 1, -1, 3, 0}, interpolation);
    for (double t = -0.5; t < 2.5; t += 0.11) {
      Dual x(t);
      x.d[1] = 1;
      EXPECT_EQ(table(x).d[1], jet_at(table, t).d1);
      EXPECT_EQ(table(x).value, table(t));
    }
  }
}

TEST(Table, KnowsWhereItsSlopeJumps) {
  EXPECT_THAT(Table("table", {0, 1, 2, 3}, {0, 1, 2, 0}, Interpolation::linear).kinks(),
              testing::ElementsAre(0, 2, 3));
  EXPECT_THAT(Table("table", {0, 1, 2, 3}, {0, 1, 2, 0}, Interpolation::spline).kinks(),
              testing::ElementsAre(0, 3));
}

TEST(Table, RefusesWhatIsNoFunction) {
  const auto message = [](std::vector<double> x, const std::vector<double>& y) {
    return message_of<InputError>([&] { Table("steer", std::move(x), y, Interpolation::linear); });
  };
  EXPECT_EQ(message({0}, {1}),
            "steer: error: a table needs at least two points (got 1)\n  add points, or give a constant");
  EXPECT_EQ(message({0, 1, 1}, {0, 1, 2}),
            "steer: error: the points of a table must ascend strictly (got 1)\n"
            "  sort them, and give one value for each");
  EXPECT_NE(message({0, 1}, {0}), "");
  EXPECT_NE(message({0, 1}, {0, std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_NE(message({0, std::numeric_limits<double>::infinity()}, {0, 1}), "");
  EXPECT_NE(message({0, 1e-310}, {0, 1e10}), "");
}

TEST(Function, IsAConstantATableOrAnExpression) {
  const std::vector<double> variables{0.5, 7};
  const std::span<const double> at(variables);
  EXPECT_EQ(Function(3)(at), 3);
  EXPECT_EQ(Function(Table("table", {0, 1}, {0, 4}, Interpolation::linear))(at), 2);
  EXPECT_EQ(Function(Table("table", {0, 14}, {0, 4}, Interpolation::linear), 1)(at), 2);
  EXPECT_EQ(Function(Expression("2*gap + t", {"t", "gap"}))(at), 14.5);
  EXPECT_EQ(Function(3).constant(), 3);
  EXPECT_THAT(Function(Table("table", {0, 1}, {0, 4}, Interpolation::linear), 1).variables(),
              testing::ElementsAre(1));
}

TEST(Function, IsEvaluatedWithoutAllocation) {
  const Function expression(
      Expression("step(t, 0, 1, 1, max(gap, 2, t)) > 1 ? gap^2 : -sin(t)", {"t", "gap"}));
  const Function table(Table("table", {0, 1, 2}, {0, 4, 0}, Interpolation::spline));
  const std::array<double, 2> numbers{0.5, 7};
  const std::array<Jet2, 2> jets{0.5, 7};
  const std::array<Dual, 2> duals{0.5, 7};
  const long before = allocation_count();
  double sum = 0;
  for (const Function* f : {&expression, &table})
    sum += (*f)(std::span<const double>(numbers)) + (*f)(std::span<const Jet2>(jets)).value +
           (*f)(std::span<const Dual>(duals)).value;
  EXPECT_EQ(allocation_count(), before);
  EXPECT_GT(sum, 0);
}

TEST(Function, StopsWhereItBends) {
  EXPECT_THAT(Function(Table("table", {0, 1, 2}, {0, 4, 5}, Interpolation::linear)).stop_times(),
              testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(Function(Table("table", {0, 1, 2}, {0, 4, 5}, Interpolation::linear), 1).stop_times(),
              testing::IsEmpty());
  EXPECT_THAT(Function(Expression("step(t, 1, 0, 2, 1)", {"t"})).stop_times(), testing::ElementsAre(1, 2));
  const std::vector<double> x = even_points(0, 10, 2000);
  EXPECT_THAT(Function(Table("table", x, values(x, std::sin), Interpolation::linear)).stop_times(),
              testing::IsEmpty());
}

}  // namespace
}  // namespace wishbone
