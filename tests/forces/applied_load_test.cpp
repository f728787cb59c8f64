#include "forces/applied_load.h"

#include <gmock/gmock.h>

#include <limits>

#include "core/dual.h"
#include "forces/support.h"

namespace wishbone {
namespace {

using testing::Applied;
using testing::applied;
using testing::message_of;
using testing::rotation;

const Wrench kLoad{Vector3(0, 0, 5), Vector3(2, 0, 0)};

MarkerState quarter_turn_about_z() {
  MarkerState m;
  m.R_WM = rotation(Vector3::UnitZ(), EIGEN_PI / 2);
  m.v_WM = Vector3(3, 7, 0);
  m.w_WM = Vector3(0, 0, 1);
  return m;
}

Function expression(const std::string& text) {
  return Function(Expression(text, {"t", "gap", "speed"}));
}

/// What a load gives at one marker for t, gap and speed.
template <class T>
WrenchT<T> wrench_at(const AppliedLoad& load, const std::vector<T>& variables) {
  const std::vector<MarkerStateT<T>> markers(1);
  std::vector<WrenchT<T>> wrenches(1);
  ForceOutputT<T> output{wrenches, {}};
  load.apply(ForceInputT<T>{value_of(variables[0]), markers, {}, 0, 0, variables}, output);
  return wrenches[0];
}

TEST(AppliedLoad, DeadLoadKeepsItsDirection) {
  const Applied a = applied(AppliedLoad("load", 0, kLoad), {quarter_turn_about_z()});
  EXPECT_EQ(a.wrenches[0].f, kLoad.f);
  EXPECT_EQ(a.wrenches[0].t, kLoad.t);
  EXPECT_DOUBLE_EQ(a.power, 2 * 3 + 5 * 1);
}

TEST(AppliedLoad, FollowerLoadTurnsWithItsMarker) {
  const Applied a = applied(AppliedLoad("load", 0, kLoad, LoadAxes::kMarker), {quarter_turn_about_z()});
  EXPECT_LT((a.wrenches[0].f - Vector3(0, 2, 0)).norm(), 1e-15);
  EXPECT_LT((a.wrenches[0].t - kLoad.t).norm(), 1e-15);
  EXPECT_NEAR(a.power, 2 * 7 + 5 * 1, 1e-14);
}

TEST(AppliedLoad, ComponentsAreFunctionsOfTimeAndSignals) {
  const LoadComponents components{
      {1.0, expression("t*speed"), 0.0},
      {expression("100 - 20*gap"), Function(Table("load", {0, 1}, {0, 8}, Table::Interpolation::linear), 1),
       3.0}};
  const AppliedLoad load("load", 0, components);
  const Wrench w = wrench_at<double>(load, {2, 0.25, -3});
  EXPECT_EQ(w.t, Vector3(1, -6, 0));
  EXPECT_EQ(w.f, Vector3(95, 2, 3));
  EXPECT_THAT(load.variables(), ::testing::IsSupersetOf({0, 1, 2}));
}

TEST(AppliedLoad, ItsDerivativesAreThoseOfItsFunctions) {
  const AppliedLoad load("load", 0,
                         {{0.0, 0.0, expression("gap^3 - speed")}, {expression("sin(t)*gap"), 0.0, 0.0}});
  std::vector<Dual> variables{0.5, 2, 3};
  variables[1].d[0] = 1;
  variables[2].d[1] = 1;
  const WrenchT<Dual> w = wrench_at<Dual>(load, variables);
  EXPECT_DOUBLE_EQ(w.t.z().d[0], 12);
  EXPECT_DOUBLE_EQ(w.t.z().d[1], -1);
  EXPECT_DOUBLE_EQ(w.f.x().d[0], std::sin(0.5));
}

TEST(AppliedLoad, StopsWhereItsTablesBendAndItsStepsBegin) {
  const AppliedLoad load(
      "load", 0,
      {{0.0, 0.0, expression("step(t, 3, 0, 4, 1)")},
       {Function(Table("load", {0, 1, 2}, {0, 5, 0}, Table::Interpolation::linear)), 0.0, 0.0}});
  EXPECT_THAT(load.stop_times(), ::testing::UnorderedElementsAre(0, 1, 2, 3, 4));
}

TEST(AppliedLoad, RejectsLoadsThatAreNotNumbers) {
  const Wrench broken{Vector3::Zero(), Vector3(0, std::numeric_limits<double>::quiet_NaN(), 0)};
  EXPECT_THROW(AppliedLoad("load", 0, broken), InputError);
}

TEST(AppliedLoad, FailsInWordsWhereItHasNoValue) {
  const AppliedLoad load("push", 0, {{}, {expression("sqrt(gap)"), 0.0, 0.0}});
  EXPECT_THAT(
      message_of<NumericsError>([&] {
        wrench_at<double>(load, {1.5, -1, 0});
      }),
      ::testing::StartsWith("push at t = 1.5 s: error: the load has no value or no derivative (got "));
}

}  // namespace
}  // namespace wishbone
