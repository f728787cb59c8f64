// Runs that fail or are broken off: they say why, name who and when, and keep what they computed.
#include "models/run_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/plan.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "text_files.h"

namespace wishbone {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A slider is driven onto the point that a spring holds it to, and reaches it at t = 0.5 s.
constexpr const char* kDrivenOntoItsSpring = R"(
wishbone: 1
gravity: [0, 0, 0]
bodies:
  slider: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0]}
  stone: {mass: 1, inertia: [1, 1, 1], position: [0, 5, 0], velocity: [2, 0, 0]}
joints:
  guide: {type: prismatic, bodies: [ground, slider], at: [0, 0, 0], axis: [1, 0, 0], motion: approach}
motions:
  approach: {steps: [{time: 0, duration: 0.5, change: -1}]}
springs:
  link: {from: {ground: [0, 0, 0]}, to: {body: slider}, stiffness: 100, damping: 1, free_length: 1}
analysis: {duration: 1 s, max_step: 0.1 s}
output: {interval: 0.1 s}
)";

RunResult run(const TextFiles& files, const char* text,
              const std::function<void(CompiledScene&)>& change = {},
              std::function<bool(double)> keep_going = {}) {
  const Scene scene = load_scene(files.write("scene.yaml", text));
  CompiledScene compiled = compile(scene);
  if (change) change(compiled);
  return run_scene(scene, compiled, {"scene.yaml", files / "out.h5", {}, std::move(keep_going)});
}

TEST(RunScene, SpringWhoseEndsMeetFailsByNameAndTimeAndKeepsTheRest) {
  const TextFiles files;
  const RunResult result = run(files, kDrivenOntoItsSpring);
  EXPECT_EQ(result.summary.status, TransientSummary::Status::failed);
  EXPECT_THAT(result.summary.message, HasSubstr("link"));
  EXPECT_THAT(result.summary.message, HasSubstr("t = 0.5"));
  const ResultFile file(files / "out.h5");
  EXPECT_THAT(file.status(), StartsWith("failed: "));
  EXPECT_GE(file.time().size(), 4) << "outputs up to the failure are kept";
  EXPECT_NEAR(file.read("/bodies/stone/position")(3, 0), 0.6, 1e-9);
}

TEST(RunScene, ImpossibleToleranceFailsByNameAndTime) {
  const TextFiles files;
  const RunResult result = run(files, kDrivenOntoItsSpring, [](CompiledScene& c) {
    c.transient.integrator.rtol = c.transient.integrator.atol = 1e-30;
  });
  EXPECT_EQ(result.summary.status, TransientSummary::Status::failed);
  EXPECT_THAT(result.summary.message, HasSubstr("t = 0"));
  EXPECT_THAT(result.summary.message, HasSubstr("(floating)"));
  EXPECT_EQ(ResultFile(files / "out.h5").time().size(), 1) << "the initial state is kept";
}

TEST(RunScene, InterruptedRunKeepsWhatItComputed) {
  const TextFiles files;
  const RunResult result = run(files, kDrivenOntoItsSpring, {}, [](double t) { return t < 0.25; });
  EXPECT_EQ(result.summary.status, TransientSummary::Status::interrupted);
  EXPECT_EQ(ResultFile(files / "out.h5").status(), "interrupted");
  EXPECT_GE(ResultFile(files / "out.h5").time().size(), 3);
}

TEST(RunScene, EnergyBookClosesWhenEveryJointIsPrescribed) {
  // nothing is left to integrate but the energies themselves; away from the end of the motion, where the spring has no length
  const TextFiles files;
  const RunResult result = run(files, kDrivenOntoItsSpring, [](CompiledScene& c) {
    c.transient.duration = 0.4;
    c.transient.integrator.rtol = c.transient.integrator.atol = 1e-9;
  });
  EXPECT_EQ(result.summary.status, TransientSummary::Status::complete);
  const ResultFile file(files / "out.h5");
  const MatrixX balance = file.read("/energy/balance");
  ASSERT_GT(file.read("/energy/input").maxCoeff(), 1.0) << "the motion did work [J]";
  EXPECT_LT((balance.array() - balance(0, 0)).abs().maxCoeff(), 1e-6);
}

TEST(RunScene, JointAboutWhichNothingHasInertiaIsNamed) {
  for (const char* place : {"[0, 0, 0]", "[1, 2, 3]", "[0.1, 0.7, -1000.3]"})
    for (const char* type : {"revolute, axis: [1, 2, 3]", "spherical"}) {
      const TextFiles files;
      const std::string text =
          std::string("wishbone: 1\nbodies:\n  bead: {mass: 1, inertia: [0, 0, 0], position: ") + place +
          "}\njoints:\n  pin: {type: " + type + ", bodies: [ground, bead], at: " + place + "}\n";
      const RunResult result = run(files, text.c_str());
      EXPECT_EQ(result.summary.status, TransientSummary::Status::failed);
      EXPECT_THAT(result.summary.message, HasSubstr("body 'bead', joint 'pin'")) << type << place;
      EXPECT_THAT(result.summary.message, HasSubstr("the inertia that moves with the joint"))
          << type << place;
    }
}

TEST(Plan, LeavesOutWhatAPendulumDoesNotNeed) {
  const Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/examples/pendulum.yaml");
  const Plan plan = make_plan(scene, compile(scene));
  EXPECT_EQ(plan.bodies, 1);
  EXPECT_EQ(plan.mobility, 1);
  EXPECT_EQ(plan.form, "ode");
  EXPECT_THAT(plan.left_out, ::testing::Contains(StartsWith("closure solver")));
  EXPECT_THAT(plan.left_out, ::testing::Contains(StartsWith("elastic terms")));
  EXPECT_THAT(plan.kept, ::testing::Contains("gravity"));
}

TEST(Plan, CountsTheCar) {
  const Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/sine_depression.yaml", {"chassis=rigid"});
  const Plan plan = make_plan(scene, compile(scene));
  EXPECT_EQ(plan.bodies, 11);
  EXPECT_EQ(plan.closure_rows, 24);
  EXPECT_THAT(plan.redundant_rows, ::testing::ElementsAre("front_left_stay (x)", "front_right_stay (x)",
                                                          "rear_left_stay (x)", "rear_right_stay (x)"));
  // chassis 6, a swing for each link, a spin for each wheel
  EXPECT_EQ(plan.mobility, 6 + 4 + 4);
}

}  // namespace
}  // namespace wishbone
