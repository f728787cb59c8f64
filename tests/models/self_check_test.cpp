// Every run keeps its own books and says when they do not come out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A pendulum of 2 kg, 1 m, whose joint follows a motion or falls freely.
std::string pendulum(const std::string& joint, const std::string& rest) {
  return "wishbone: 1\nbodies:\n  rod: {mass: 2, inertia: [0.1, 0.1, 0.1], position: [0, 0, -1]}\n"
         "joints:\n  pin: {type: revolute, bodies: [ground, rod], at: [0, 0, 0], axis: [0, 1, 0]" +
         joint + "}\n" + rest;
}

std::string driven(const std::string& law, const std::string& extra = "") {
  return pendulum(", motion: drive" + extra,
                  "motions: {drive: {expression: '" + law + "'}}\nanalysis: {duration: 0.5}\n");
}

struct Told {
  RunResult result;
  std::vector<std::string> in_file;  ///< the warnings in the results
};

Told run(const std::string& text) {
  const TextFiles files;
  const Scene scene = load_scene(files.write("scene.yaml", text));
  Told told;
  told.result = run_scene(scene, compile(scene), {"scene.yaml", files / "out.h5", {}, {}});
  const ResultFile file(files / "out.h5");
  const auto meta = file.meta();
  if (const auto* lines = std::get_if<std::vector<std::string>>(&meta.at("warnings"))) told.in_file = *lines;
  return told;
}

std::string refusal_of(const std::string& text) {
  return message_of<InputError>([&] { run(text); });
}

TEST(SelfCheck, AMotionThatJumpsIsRefusedWithJointTimeAndJump) {
  for (const char* extra : {"", ", cut: true"}) {
    EXPECT_THAT(refusal_of(driven("t > 0.1 ? 1 : 0", extra)),
                AllOf(HasSubstr("joint 'pin"),
                      HasSubstr("at t = 0.1 s: error: the prescribed motion jumps (got from 0 to 1 rad)")));
    // by a sign, an inverse tangent that wraps, and a pulse shorter than any step
    EXPECT_THAT(refusal_of(driven("0.5*sign(t - 0.2)", extra)), HasSubstr("t = 0.2 s"));
    EXPECT_THAT(refusal_of(driven("atan2(sin(20*t), cos(20*t))", extra)), HasSubstr("t = 0.157079633 s"));
    EXPECT_THAT(refusal_of(driven("t > 0.3 && t < 0.3000001 ? 1 : 0", extra)), HasSubstr("t = 0.3"));
  }
}

TEST(SelfCheck, ASpeedThatJumpsIsTold) {
  const Told told = run(driven("t < 0.25 ? 0 : 2*(t - 0.25)"));
  EXPECT_EQ(told.result.summary.status, TransientSummary::Status::complete);
  ASSERT_FALSE(told.result.warnings.empty());
  EXPECT_THAT(told.result.warnings.front().warning(),
              AllOf(HasSubstr("joint 'pin' at t = 0.25 s: warning: the speed of the prescribed motion jumps"),
                    HasSubstr("from 0 to 2 rad/s")));
  ASSERT_EQ(told.in_file.size(), told.result.warnings.size());
  EXPECT_EQ(told.in_file.front(), told.result.warnings.front().warning());
}

TEST(SelfCheck, SteepButSmoothMotionsAreNotTold) {
  for (const char* law : {"tanh((t - 0.1)/1e-2)", "step(t, 0.1, 0, 0.1001, 1)", "sin(3000*t)",
                          "0.001*exp(10*t)", "t < 0.25 ? 0 : (t - 0.25)^2", "abs(t - 0.1)^3"}) {
    const Told told = run(driven(law));
    EXPECT_EQ(told.result.summary.status, TransientSummary::Status::complete) << law;
    for (const Diagnostic& warning : told.result.warnings) ADD_FAILURE() << law << ": " << warning.warning();
  }
}

/// A pendulum that the function `twist` of the angle drives, with rtol as given.
std::string twisted(const std::string& twist, const std::string& analysis) {
  return pendulum(", position: 1",
                  "signals: {turn: {joint: pin}, rate: {joint: pin, quantity: speed}}\nloads: {twist: "
                  "{joint: pin, moment: {expression: '" +
                      twist + "'}}}\nanalysis: {duration: 10, " + analysis + "}\n");
}

TEST(SelfCheck, BooksThatDoNotComeOutAreToldWithTheirTime) {
  // a motion that is over within one step, so that its work is missed
  const Told told = run(driven("tanh((t - 0.1)/1e-4)"));
  EXPECT_EQ(told.result.summary.status, TransientSummary::Status::complete);
  ASSERT_EQ(told.result.warnings.size(), 1u);
  EXPECT_THAT(told.result.warnings.front().warning(),
              AllOf(HasSubstr("energy, most of all from t = 0.09 s to 0.1 s"),
                    HasSubstr("the energy balance has moved")));
  EXPECT_EQ(told.in_file.front(), told.result.warnings.front().warning());
}

TEST(SelfCheck, BooksComeOutAtEveryToleranceThatIsInUse) {
  for (const char* analysis :
       {"rtol: 1e-3, atol: 1e-5", "rtol: 1e-6, atol: 1e-8", "rtol: 1e-10, atol: 1e-12",
        "integrator: bdf, rtol: 1e-6, atol: 1e-8", "integrator: adams, rtol: 1e-6, atol: 1e-8"}) {
    const Told told = run(twisted("sin(3*t) - 0.1*rate", analysis));
    for (const Diagnostic& warning : told.result.warnings)
      ADD_FAILURE() << analysis << ": " << warning.warning();
  }
}

}  // namespace
}  // namespace wishbone
