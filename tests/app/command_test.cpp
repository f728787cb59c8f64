// The command as a user meets it: exit codes and output of the installed program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/wait.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/small_run.h"
#include "app/synthetic_run.h"
#include "solver/result_file.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Answer {
  int code = -1;
  std::string text;  ///< standard output and error
};

Answer call(const std::string& arguments) {
  FILE* pipe = popen((std::string(WISHBONE_COMMAND) + " " + arguments + " 2>&1").c_str(), "r");
  Answer answer;
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) answer.text.append(buffer, n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.code = WEXITSTATUS(status);
  return answer;
}

class CommandTest : public testing::Test {
 protected:
  CommandTest() {
    SmallRun().write(folder_ / "a.h5");
    SmallRun other;
    other.scalar = [](double t) { return t == 2 ? 2.5 : t; };
    other.write(folder_ / "b.h5");
  }
  std::string a() const { return folder_ / "a.h5"; }
  std::string b() const { return folder_ / "b.h5"; }
  TemporaryFolder folder_;
};

TEST_F(CommandTest, HelpOfEveryCommandHasAnExample) {
  EXPECT_EQ(call("--help").code, 0);
  for (const std::string command : {"check", "compare", "extract", "info"}) {
    const Answer answer = call(command + " --help");
    EXPECT_EQ(answer.code, 0);
    EXPECT_THAT(answer.text, HasSubstr("Example:\n  wishbone " + command));
  }
}

TEST_F(CommandTest, BadInputGivesTwo) {
  EXPECT_EQ(call("").code, 2);
  EXPECT_EQ(call("fly").code, 2);
  EXPECT_EQ(call("info").code, 2);
  EXPECT_THAT(call("info " + (folder_ / "absent.h5")).text, HasSubstr("absent.h5: error: no such file"));
  EXPECT_EQ(call("info " + (folder_ / "absent.h5")).code, 2);
  EXPECT_EQ(call("check " + a() + " --against " + (folder_ / "absent.h5")).code, 2);
  EXPECT_EQ(call("check " + a() + " --against " + a() + " --tol nonsense").code, 2);
  EXPECT_EQ(call("compare " + a() + " " + b() + " --signals '/nothing*'").code, 2);
}

TEST_F(CommandTest, FailureToWriteGivesThree) {
  EXPECT_EQ(call("extract " + a() + " -o /nowhere/base.h5").code, 3);
  EXPECT_EQ(call("compare " + a() + " " + b() + " --html /nowhere/report.html").code, 3);
}

TEST_F(CommandTest, CheckGivesZeroWithinAndOneBeyondTheTolerance) {
  EXPECT_EQ(call("check " + a() + " --against " + a()).code, 0);
  const Answer beyond = call("check " + b() + " --against " + a());
  EXPECT_EQ(beyond.code, 1);
  EXPECT_THAT(beyond.text, AllOf(HasSubstr("FAILED /group/scalar: differs by 0.5 m at 2 s"),
                                 HasSubstr("3 of 4 checks passed")));
  EXPECT_EQ(call("check --tol '/group/*=0.2' " + b() + " --against " + a()).code, 0);
  std::ofstream(folder_ / "t.yaml") << "\"/group/*\": {absolute: 0.6}\n";
  EXPECT_EQ(call("check " + b() + " --against " + a() + " --tolerances " + (folder_ / "t.yaml")).code, 0);
}

TEST_F(CommandTest, CheckWritesJunitAndJson) {
  const Answer answer = call("check " + b() + " --against " + a() + " --json --junit " + (folder_ / "j.xml"));
  EXPECT_EQ(answer.code, 1);
  const auto json = nlohmann::json::parse(answer.text);
  EXPECT_FALSE(json["passed"]);
  EXPECT_EQ(json["checks"].size(), 4u);
  EXPECT_EQ(json["checks"][2]["difference"], 0.5);
  std::ifstream file(folder_ / "j.xml");
  EXPECT_THAT((std::ostringstream() << file.rdbuf()).str(), HasSubstr("tests=\"4\" failures=\"1\""));
}

TEST_F(CommandTest, CompareSpeaksToPeopleAndMachines) {
  const Answer lines = call("compare " + a() + " " + b() + " --title-a Before --title-b After");
  EXPECT_EQ(lines.code, 0);
  EXPECT_THAT(lines.text, AllOf(HasSubstr("A: Before"), HasSubstr("/group/scalar"), HasSubstr("0.5")));
  const auto json = nlohmann::json::parse(call("compare " + a() + " " + b() + " --json").text);
  EXPECT_EQ(json["differences"][0]["max_difference"], 0.5);
  EXPECT_EQ(json["differences"][0]["time_of_maximum"], 2);
  EXPECT_EQ(json["b"]["title"], "b");
}

TEST_F(CommandTest, ExtractMakesABaselineThatTheRunMeets) {
  write_synthetic_run(folder_ / "run.h5", {});
  const std::string base = folder_ / "base.h5";
  const Answer made = call("extract " + (folder_ / "run.h5") + " -o " + base +
                           " --every 10ms --signals '/vehicle/*' '/tires/*/deflection'");
  EXPECT_EQ(made.code, 0) << made.text;
  const ResultFile file(base);
  EXPECT_EQ(file.signals().size(), 12u);
  EXPECT_EQ(file.time().size(), 201);
  EXPECT_EQ(file.status(), "complete");
  EXPECT_TRUE(file.run_meta().empty());
  EXPECT_EQ(call("check " + (folder_ / "run.h5") + " --against " + base).code, 0);
  EXPECT_EQ(call("check " + base + " --against " + (folder_ / "run.h5")).code, 1);
}

TEST_F(CommandTest, ExtractRefusesInstantsThatWereNotRecorded) {
  const Answer answer = call("extract " + a() + " -o " + (folder_ / "base.h5") + " --every 0.5");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("0.5 s"));
}

TEST_F(CommandTest, InfoTellsWhatIsInAFile) {
  const Answer lines = call("info " + a());
  EXPECT_EQ(lines.code, 0);
  EXPECT_THAT(lines.text, AllOf(HasSubstr("status: complete"), HasSubstr("time: 0 s to 4 s, 5 rows"),
                                HasSubstr("/group/vector"), HasSubstr("[5, 3]"), HasSubstr("world")));
  const auto json = nlohmann::json::parse(call("info --json " + a()).text);
  EXPECT_EQ(json["time"]["rows"], 5);
  EXPECT_EQ(json["meta"]["status"], "complete");
}

}  // namespace
}  // namespace wishbone
