// Work without progress ends, and every evaluation looks at the user's wish.
#include "solver/progress_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using ::testing::HasSubstr;

TEST(ProgressGuard, EndsAStepThatIsNeverAccepted) {
  ProgressGuard guard({}, {});
  guard.start(2.5);
  for (int i = 0; i < ProgressGuard::kStepEvaluations; ++i) guard.count();
  try {
    guard.count();
    FAIL() << "went on";
  } catch (const HopelessRun& error) {
    EXPECT_THAT(error.what(), HasSubstr("t = 2.5 s"));
  }
}

TEST(ProgressGuard, EndsARunThatCreepsAndCountsTheSizeOfTheProblem) {
  for (const double size : {100.0, 1000.0}) {
    ProgressGuard guard({size, 1e-3}, {});
    guard.start(0);
    double t = 0;
    const auto creep = [&](double progress) {
      for (double work = 0; work < ProgressGuard::kPatience / size; work += 1000) {
        guard.count(1000);
        guard.accept(t += progress * 1000 * size / ProgressGuard::kPatience);
      }
    };
    EXPECT_NO_THROW(creep(2e-3)) << size;
    EXPECT_THROW(creep(0.4e-3), HopelessRun) << size;
  }
}

TEST(ProgressGuard, EndsARunWhoseStepsAdvanceByLessThanABillionthOfItsDuration) {
  ProgressGuard guard({1, 1e-3, 5}, {});
  guard.start(1);
  double t = 1;
  const auto creep = [&](double advance) {
    for (long i = 0; i < ProgressGuard::kStepPatience; ++i)
      guard.accept(t += advance / ProgressGuard::kStepPatience);
  };
  EXPECT_NO_THROW(creep(6e-9));
  try {
    creep(4e-9);
    FAIL() << "went on";
  } catch (const HopelessRun& error) {
    EXPECT_THAT(error.what(), HasSubstr("in the last 10000 steps"));
  }
}

TEST(ProgressGuard, LetsARunCreepWhoseStepsTheUserHasCounted) {
  ProgressGuard guard({1, 0, 1}, {});
  guard.start(0);
  for (int i = 0; i < 30'000; ++i) {
    guard.count(1000);
    EXPECT_NO_THROW(guard.accept(1e-12 * i));
  }
}

TEST(ProgressGuard, AsksWithinAStepWhetherToGoOn) {
  // an endless iteration never comes to the end of a step
  bool wanted = true;
  ProgressGuard guard({}, [&](double) { return wanted; });
  guard.start(0);
  for (int i = 0; i < 100; ++i) guard.count();
  wanted = false;
  int i = 0;
  EXPECT_THROW(
      {
        for (; i < 1000; ++i) guard.count();
      },
      Interrupted);
  EXPECT_LT(i, 100);
}

TEST(ProgressGuard, InterruptsARunWithinTheFirstStepOfEachIntegrator) {
  for (const auto& [form, method] : {std::pair(Form::index1, Method::erk),
                                     {Form::index1, Method::bdf},
                                     {Form::index1, Method::adams},
                                     {Form::partition, Method::bdf},
                                     {Form::ggl, Method::bdf}}) {
    const testing::Built m = testing::four_bar(SphericalClosure{}, 1.0);
    Workspace ws(m.system);
    TransientOptions options;
    options.integrator.form = form;
    options.integrator.method = method;
    options.duration = 10;
    options.interval = 0.1;
    int asked = 0;
    const TransientSummary summary = run_transient(
        m.system, m.state, options, ws, [](const State&, const Work&) {},
        [&](double) { return ++asked < 30; });
    EXPECT_EQ(summary.status, TransientSummary::Status::interrupted) << to_string(form) << to_string(method);
    EXPECT_EQ(asked, 30);
    EXPECT_LT(summary.t_end, 10);
  }
}

}  // namespace
}  // namespace wishbone
