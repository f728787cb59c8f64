// What `plan` and `run` tell of mechanisms with loops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/call.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A spatial four-bar whose ball joint at `far` is a millimetre open: the rocker starts 2.5 mrad off.
constexpr const char* kOpenFourBar = R"(
wishbone: 1
bodies:
  crank: {mass: 1, inertia: [0.02, 0.03, 0.04], position: [0.05, 0.1, 0]}
  coupler: {mass: 2, inertia: [0.2, 0.1, 0.2], position: [0.3, 0.3, 0.2]}
  rocker: {mass: 1.5, inertia: [0.1, 0.05, 0.1], position: [0.6, 0.3, 0.2]}
joints:
  motor: {type: revolute, bodies: [ground, crank], at: [0, 0, 0], axis: [0, 0, 1]}
  near: {type: spherical, bodies: [crank, coupler], at: [0.1, 0.2, 0]}
  far: {type: spherical, bodies: [rocker, coupler], at: [0.6, 0.4, 0.4]}
  hinge: {type: revolute, bodies: [ground, rocker], at: [0.6, 0.2, 0], axis: [1, 0, 0], position: 0.0025}
analysis: {duration: 0.1 s}
)";

TEST(PlanCommand, TellsTheTreeItsReasonsAndTheGaps) {
  const TextFiles files;
  const Answer answer = call("plan " + files.write("scene.yaml", kOpenFourBar).string());
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, AllOf(HasSubstr("rows 3, rank 3, redundant 0"), ContainsRegex("mobility +2 ")));
  EXPECT_THAT(
      answer.text,
      ContainsRegex("far +spherical +rocker - coupler +cut +3 +closes the loop with motor, near, hinge; "
                    "saves 2 rows against 'motor'"));
  EXPECT_THAT(answer.text, ContainsRegex("hinge +revolute .* tree +has initial values; would cost 5 rows"));
  EXPECT_THAT(answer.text, ContainsRegex("far +spherical +3 +0\\.00[0-9]+ m +closed"));
}

TEST(PlanCommand, GivesProgramsTheSame) {
  const TextFiles files;
  const Answer answer = call("plan --json " + files.write("scene.yaml", kOpenFourBar).string());
  const auto plan = nlohmann::json::parse(answer.text);
  EXPECT_EQ(plan["rank"], 3);
  EXPECT_EQ(plan["mobility"], 2);
  EXPECT_EQ(plan["joints"][2]["cut"], true);
  EXPECT_EQ(plan["joints"][2]["rows_saved"], 2);
  EXPECT_EQ(plan["closures"][0]["closure"], "far");
  // each row of the gap is at most the arc of 2.5 mrad at 0.447 m
  EXPECT_GT(plan["closures"][0]["assembly"]["length_before"], 0.5e-3);
  EXPECT_LT(plan["closures"][0]["assembly"]["length_before"], 0.0025 * 0.448);
  EXPECT_LT(plan["closures"][0]["assembly"]["length_after"], 1e-12);
}

TEST(PlanCommand, NamesRedundantRowsByJointAndDirection) {
  const Answer answer = call("plan " WISHBONE_SCENES "/benchmarks/n_four_bar.yaml --set N=1");
  EXPECT_THAT(answer.text, AllOf(HasSubstr("rows 5, rank 2, redundant 3"), HasSubstr("right_1 (z)")));
}

TEST(RunCommand, TellsWhichClosuresWereOpen) {
  const TextFiles files;
  const std::string scene = files.write("scene.yaml", kOpenFourBar);
  const Answer answer = call("run " + scene + " -o " + (files / "out.h5").string());
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, ContainsRegex("assembled: far was open by 0\\.00[0-9]+ m, after closed"));
  EXPECT_THAT(answer.text, Not(HasSubstr("singular")));
  EXPECT_THAT(call("info " + (files / "out.h5").string()).text, ContainsRegex("assembly_gaps: far: 0\\.00"));
}

TEST(RunCommand, TellsSingularPassages) {
  // the parallelogram lies in line where its crank has turned by a quarter, after about a second
  const TextFiles files;
  const std::string command = "run " WISHBONE_SCENES "/benchmarks/n_four_bar.yaml --set N=1 --until 2 -o " +
                              (files / "out.h5").string();
  EXPECT_THAT(call(command).text,
              ContainsRegex("singular position passed at t = [01]\\.[0-9]+ s: right_1 \\("));
  const auto json = nlohmann::json::parse(call(command + " --json").text);
  ASSERT_GE(json["singular_passages"].size(), 1u);
  EXPECT_THAT(json["singular_passages"][0]["row"].get<std::string>(), HasSubstr("right_1"));
  EXPECT_GT(json["work"]["closure_factorizations"], 0);
  EXPECT_EQ(json["work"]["signal_evaluations"], 0);
}

}  // namespace
}  // namespace wishbone
