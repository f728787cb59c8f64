// The four-bar mechanism with a misaligned joint, models/scenes/benchmarks/flexible_four_bar.yaml, where the source is cited:
// rigid bars lock it, flexible ones let it move at the cost of energy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "models/compile.h"
#include "models/plan.h"
#include "models/scene_loader.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"
#include "solver/loads.h"

namespace wishbone {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Scene flexible_four_bar(const std::vector<std::string>& overrides) {
  return load_scene(std::filesystem::path(WISHBONE_SCENES) / "benchmarks" / "flexible_four_bar.yaml",
                    overrides);
}

Plan plan_of_four_bar(const std::vector<std::string>& overrides) {
  const Scene scene = flexible_four_bar(overrides);
  return make_plan(scene, compile(scene));
}

TEST(FlexibleFourBar, LocksAtTheMisalignedJointWhenItsBarsAreRigid) {
  // the coupler moves in its plane and the rocker in its own: the row that keeps them from tilting against each other about
  // the coupler follows from the others in the aligned mechanism, and takes its only freedom in the misaligned one
  const std::string tilt = "C (tilt about x)";
  const Plan aligned = plan_of_four_bar({"form=rigid", "drive=free", "misalignment=0 deg"});
  EXPECT_EQ(aligned.mobility, 1);
  EXPECT_THAT(aligned.redundant_rows, Contains(tilt));
  const Plan misaligned = plan_of_four_bar({"form=rigid", "drive=free"});
  EXPECT_EQ(misaligned.mobility, 0);
  EXPECT_THAT(misaligned.redundant_rows, Not(Contains(tilt)));
  // flexible bars have a freedom for every row
  const Plan flexible = plan_of_four_bar({"drive=free"});
  EXPECT_THAT(flexible.redundant_rows, ::testing::IsEmpty());
  EXPECT_EQ(flexible.mobility, flexible.speeds + flexible.elastic_coordinates - flexible.closure_rows);
}

TEST(FlexibleFourBar, RefusesToBeDrivenWhenItsBarsAreRigid) {
  // the drive leaves too few freedoms for the rows at C, which are closed at the start alone
  for (const Form form : {Form::index1, Form::partition, Form::ggl}) {
    SCOPED_TRACE(to_string(form));
    CompiledScene compiled = compile(flexible_four_bar({"form=rigid"}));
    compiled.transient.integrator.form = form;
    Workspace ws(compiled.system);
    const TransientSummary summary = run_transient(compiled.system, compiled.initial, compiled.transient, ws,
                                                   [](const State&, const Work&) {});
    EXPECT_EQ(summary.status, TransientSummary::Status::failed);
    EXPECT_THAT(summary.message, HasSubstr("C (tilt about x)"));
    EXPECT_THAT(summary.message, HasSubstr("contradict"));
  }
}

/// What the drive has put in, and what has become of it [J].
struct Account {
  Energy energy;
  Work work;
  double sum() const { return energy.kinetic + energy.elastic + work.loss - work.input; }
};

std::vector<Account> run_four_bar(const std::vector<std::string>& overrides, double duration,
                                  double rtol = 1e-6) {
  const CompiledScene compiled = compile(flexible_four_bar(overrides));
  TransientOptions options = compiled.transient;
  options.duration = duration;
  options.integrator.rtol = rtol;
  options.integrator.atol = rtol / 100;
  Workspace run_ws(compiled.system), ws(compiled.system);
  std::vector<Account> accounts;
  const TransientSummary summary = run_transient(
      compiled.system, compiled.initial, options, run_ws, [&](const State& state, const Work& work) {
        update_state(compiled.system, state, ws);
        remember_angles(compiled.system, state, ws);  // the turns of the crank
        update_state(compiled.system, state, ws);
        EXPECT_LT(ws.Phi.cwiseAbs().maxCoeff(), 1e-11) << "at " << state.t << " s";
        accounts.push_back({calc_energy(compiled.system, state, ws), work});
      });
  EXPECT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
  return accounts;
}

TEST(FlexibleFourBar, StoresTheWorkOfItsDriveWhenItsBarsAreFlexible) {
  // two turns of the crank, four times through the position with all bars in line
  const std::vector<Account> run = run_four_bar({}, 21, 1e-7);
  ASSERT_EQ(run.size(), 421u);
  double exchanged = 0, error = 0, motion = 0;
  for (const Account& account : run) {
    exchanged = std::max(exchanged, account.work.input);
    error = std::max(error, std::abs(account.sum() - run.front().sum()));
    motion = std::max(motion, account.energy.kinetic);
  }
  EXPECT_GT(exchanged, 1000 * motion) << "the misaligned joint takes thousands of times the energy in motion";
  EXPECT_LT(run.back().work.input, 0.02 * exchanged) << "the bars give it back after every position in line";
  EXPECT_LE(error, 1e-6 * exchanged);
}

TEST(FlexibleFourBar, StoresAsMuchAsTheSquareOfTheMisalignment) {
  // small strain: the bars take up a misfit that is proportional to the sine of the angle
  const double degree = std::numbers::pi / 180;
  const double whole = run_four_bar({}, 1).back().energy.elastic;
  const double half = run_four_bar({"misalignment=2.5 deg"}, 1).back().energy.elastic;
  EXPECT_NEAR(whole / half, std::pow(std::sin(5 * degree) / std::sin(2.5 * degree), 2), 0.04);
  const double aligned = run_four_bar({"misalignment=0 deg"}, 1).back().energy.elastic;
  EXPECT_LT(aligned, 1e-9 * whole) << "what the spin of the bars alone does to them";
}

}  // namespace
}  // namespace wishbone
