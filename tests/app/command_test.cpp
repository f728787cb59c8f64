// The command as a user meets it: exit codes and output of the installed program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/call.h"
#include "app/small_run.h"
#include "app/synthetic_run.h"
#include "solver/result_file.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return (std::ostringstream() << file.rdbuf()).str();
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
  const Answer version = call("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.text, testing::StartsWith("wishbone 0."));
  for (const std::string command : {"check", "compare", "convert", "extract", "info", "modes"}) {
    const Answer answer = call(command + " --help");
    EXPECT_EQ(answer.code, 0);
    EXPECT_THAT(answer.text, HasSubstr("Example:\n  wishbone " + command));
  }
}

TEST_F(CommandTest, TextsThatAreNotUtf8AreToldAsLatin1) {
  {
    Recorder recorder(folder_ / "c.h5", {{"/x", {}, "m/s\xB2", "", "", {}}});
    recorder.append(0, std::vector<double>{1});
    recorder.set_meta("title", "H\xFClle");
    recorder.close(Outcome::kComplete);
  }
  EXPECT_THAT(call("info " + (folder_ / "c.h5")).text, HasSubstr("H\u00FClle"));
  const Answer answer = call("info --json " + (folder_ / "c.h5"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_EQ(nlohmann::json::parse(answer.text)["meta"]["title"], "H\u00FClle");
  std::filesystem::rename(folder_ / "c.h5", folder_ / "\xFC.h5");
  EXPECT_EQ(call("info --json " + (folder_ / "\xFC.h5")).code, 0);
}

TEST_F(CommandTest, BrokenBytesOfAResultAreBadInput) {
  const std::string whole = bytes(a());
  int refused = 0;
  for (std::size_t at = 8; at < whole.size(); at += std::max<std::size_t>(1, at / 8)) {
    std::string broken = whole;
    for (std::size_t i = at; i < std::min(at + 3, whole.size()); ++i)
      broken[i] = static_cast<char>(~broken[i]);
    std::ofstream(folder_ / "c.h5", std::ios::binary) << broken;
    for (const std::string& command :
         {"info --json " + (folder_ / "c.h5"), "compare --all " + (folder_ / "c.h5") + " " + b()}) {
      const Answer answer = call(command);
      EXPECT_TRUE(answer.code == 0 || answer.code == 2)
          << command << ", byte " << at << ": " << answer.code << answer.text;
      if (answer.code != 2) continue;
      ++refused;
      EXPECT_THAT(answer.text, HasSubstr("c.h5"));
    }
  }
  EXPECT_GT(refused, 10);
}

TEST_F(CommandTest, TimeThatIsAScalarIsBadInput) {
  {
    hdf5::File file = hdf5::File::create(folder_ / "c.h5");
    const double zero = 0;
    file.write("/time", {}, {&zero, 1});
    file.close();
  }
  EXPECT_EQ(call("info " + (folder_ / "c.h5")).code, 0);
  const Answer answer = call("compare " + (folder_ / "c.h5") + " " + b());
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("c.h5:/time: error: the times of a result are one number for each row"));
}

TEST_F(CommandTest, BadInputGivesTwo) {
  EXPECT_EQ(call("").code, 2);
  EXPECT_EQ(call("fly").code, 2);
  EXPECT_THAT(call("rnu").text, AllOf(HasSubstr("wishbone: error: no such command (got 'rnu')"),
                                      HasSubstr("did you mean 'run'?")));
  EXPECT_EQ(call("info").code, 2);
  EXPECT_THAT(call("info " + (folder_ / "absent.h5")).text,
              HasSubstr("absent.h5: error: there is no such file"));
  EXPECT_EQ(call("info " + (folder_ / "absent.h5")).code, 2);
  EXPECT_EQ(call("check " + a() + " --against " + (folder_ / "absent.h5")).code, 2);
  EXPECT_EQ(call("check " + a() + " --against " + a() + " --tol nonsense").code, 2);
  EXPECT_EQ(call("compare " + a() + " " + b() + " --signals '/nothing*'").code, 2);
}

TEST_F(CommandTest, ADiskThatRunsFullGivesThree) {
  const std::string full_at_512_bytes = "trap '' XFSZ; ulimit -f 1";
  const Answer extract = call("extract " + a() + " -o " + (folder_ / "base.h5"), full_at_512_bytes);
  EXPECT_EQ(extract.code, 3) << extract.text;
  const Answer page =
      call("compare " + a() + " " + b() + " --html " + (folder_ / "r.html"), full_at_512_bytes);
  EXPECT_EQ(page.code, 3) << page.text;
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

TEST_F(CommandTest, ExtractRefusesAStepLongerThanTheRun) {
  EXPECT_THAT(call("extract " + a() + " -o " + (folder_ / "base.h5") + " --every '5 s'").text,
              HasSubstr("the step is longer than the run of 4 s"));
  EXPECT_EQ(call("extract " + a() + " -o " + (folder_ / "base.h5") + " --every 1e-25").code, 2);
  EXPECT_EQ(call("extract " + a() + " -o " + (folder_ / "base.h5") + " --every 4000ms").code, 0);
}

TEST_F(CommandTest, ToleranceOfTheCommandLineThatTouchesNoSignalIsRefused) {
  const std::string same = "check " + a() + " --against " + a();
  const Answer answer = call(same + " --tol '/gruop/scalar=1e-12'");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("'/gruop/scalar'"), HasSubstr("did you mean '/group/scalar'?")));
  std::ofstream(folder_ / "t.yaml") << "\"/of another car/*\": {absolute: 0.6}\n";
  EXPECT_EQ(call(same + " --tolerances " + (folder_ / "t.yaml")).code, 0);
}

TEST_F(CommandTest, OutputThatCannotBeWrittenOrIsAnInputIsRefusedFirst) {
  std::filesystem::create_directory(folder_ / "folder");
  std::filesystem::create_symlink(a(), folder_ / "also_a.h5");
  std::filesystem::create_symlink("/dev/full", folder_ / "device");  // never by its own name: it can be lost
  std::filesystem::copy(a(), folder_ / "c.h5.partial");
  const std::string before = bytes(a());
  for (const std::string& output :
       {std::string("''"), folder_ / "absent/x", folder_ / "folder", folder_ / "device", a(),
        folder_ / "also_a.h5", folder_ / "folder/../a.h5", folder_ / std::string(300, 'x')}) {
    EXPECT_EQ(call("extract " + a() + " -o " + output).code, 2) << output;
    EXPECT_EQ(call("compare " + b() + " " + a() + " --html " + output).code, 2) << output;
    EXPECT_EQ(call("check " + b() + " --against " + a() + " --junit " + output).code, 2) << output;
  }
  EXPECT_EQ(call("extract " + (folder_ / "c.h5.partial") + " -o " + (folder_ / "c.h5")).code, 2);
  EXPECT_EQ(bytes(a()), before);
  EXPECT_EQ(bytes(folder_ / "c.h5.partial"), before);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "device"));
}

/// A scene that includes its bodies, and a results file that is worth keeping.
class RunCommandTest : public CommandTest {
 protected:
  RunCommandTest() {
    std::ofstream(scene()) << R"(
wishbone: 1
include: rod.yaml
joints:
  pin: {type: revolute, bodies: [ground, rod], at: [0, 0, 0], axis: [0, 1, 0], position: 60 deg}
analysis: {duration: 1 s}
output: {interval: 10 ms}
)";
    std::ofstream(folder_ / "rod.yaml")
        << "bodies: {rod: {mass: 2 kg, inertia: [0.135, 0.135, 0.001], position: [0, 0, -0.45]}}\n";
  }
  std::string scene() const { return folder_ / "scene.yaml"; }
  Answer run(const std::string& arguments) const { return call("run " + scene() + " " + arguments); }
};

TEST_F(RunCommandTest, BadInputLeavesEarlierResultsAsTheyAre) {
  const std::string before = bytes(a());
  const std::string open_loop = folder_ / "open.yaml";
  std::ofstream(open_loop) << R"(
wishbone: 1
include: rod.yaml
motions:
  turn: {start: 60 deg}
joints:
  pin: {type: revolute, bodies: [ground, rod], at: [0, 0, 0], axis: [0, 1, 0], motion: turn}
  far: {type: spherical, cut: true, bodies: [ground, rod], at: [0, 0, -0.9]}
analysis: {duration: 1 s}
)";
  EXPECT_EQ(run("-o " + a() + " --form ggl --integrator adams").code, 2);
  const Answer answer = call("run " + open_loop + " -o " + a());
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("cut joint 'far"));
  EXPECT_EQ(bytes(a()), before);
  EXPECT_FALSE(std::filesystem::exists(a() + ".partial"));
}

TEST_F(RunCommandTest, OutputMayNotReplaceTheSceneNorWhatItIncludes) {
  for (const std::string name : {"scene.yaml", "rod.yaml"}) {
    const std::string before = bytes(folder_ / name);
    EXPECT_THAT(run("-o " + (folder_ / name)).text, HasSubstr("the output would replace an input")) << name;
    EXPECT_EQ(bytes(folder_ / name), before);
  }
  EXPECT_EQ(run("-o ''").code, 2);
  std::filesystem::create_symlink("/dev/full", folder_ / "device");
  EXPECT_EQ(run("-o " + (folder_ / "device")).code, 2);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "device"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "device.lock"));
}

TEST_F(RunCommandTest, AnalysisOptionsHaveTheLimitsOfTheScene) {
  const std::vector<std::pair<std::string, std::string>> bad{
      {"--rtol 0.2", "--rtol: error: the relative tolerance is too coarse to mean anything (got '0.2')"},
      {"--rtol 0", "--rtol: error: the value must be greater than 0 (got '0')"},
      {"--rtol nan", "--rtol: error: not a finite number (got 'nan')"},
      {"--atol -1", "--atol: error: the value must be greater than 0 (got '-1')"},
      {"--atol 1e999", "--atol: error: the number does not fit a double"},
      {"--until 0", "--until: error: the value must be greater than 0 (got '0')"},
      {"--until 5kg", "--until: error: wrong dimension"},
      {"--until 1e9", "--until: error: the run would have more than ten million outputs"},
      {"--form 2", "the integration forms are: auto, ode, index1, partition, ggl"},
      {"--form gll", "did you mean 'ggl'?"},
      {"--integrator bfd", "did you mean 'bdf'?"}};
  for (const auto& [option, message] : bad) {
    const Answer answer = run("-o " + (folder_ / "out.h5") + " " + option);
    EXPECT_EQ(answer.code, 2) << option;
    EXPECT_THAT(answer.text, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.h5"));
  }
}

TEST_F(RunCommandTest, UntilTakesUnitsAndCutsTheIntervalOfOutputs) {
  EXPECT_EQ(run("-o " + (folder_ / "out.h5") + " --until '0.2 s'").code, 0);
  EXPECT_EQ(ResultFile(folder_ / "out.h5").time().size(), 21);
  EXPECT_EQ(run("-o " + (folder_ / "out.h5") + " --until 5ms").code, 0);
  const VectorX time = ResultFile(folder_ / "out.h5").time();
  ASSERT_EQ(time.size(), 2);
  EXPECT_EQ(time[1], 0.005);
}

TEST_F(RunCommandTest, MetaTellsWhatWasAskedAndWhatWasUsed) {
  EXPECT_EQ(run("-o " + (folder_ / "out.h5") + " --until 5ms --rtol 1e-4 --form auto").code, 0);
  const auto meta = ResultFile(folder_ / "out.h5").meta();
  EXPECT_THAT(std::get<std::vector<std::string>>(meta.at("command_line")),
              ElementsAre("--form auto", "--rtol 1e-4", "--until 5ms"));
  EXPECT_EQ(std::get<std::string>(meta.at("form")), "ode");
  EXPECT_EQ(std::get<double>(meta.at("rtol")), 1e-4);
}

TEST_F(RunCommandTest, InterruptedRunTellsItsProgressInALogAndGivesThree) {
  const std::string interrupt_after_two_seconds = "(sleep 2.5; kill -INT $$) >/dev/null 2>&1 & true";
  const Answer answer = call("run " + scene() + " -o " + (folder_ / "out.h5") + " --until '50000 s'",
                             interrupt_after_two_seconds);
  EXPECT_EQ(answer.code, 3);
  EXPECT_THAT(answer.text,
              AllOf(ContainsRegex("t = [0-9.e+]+ s of 50000 s\n"), HasSubstr("interrupted at t =")));
  EXPECT_LE(std::count(answer.text.begin(), answer.text.end(), '\n'), 12) << answer.text;
  EXPECT_EQ(ResultFile(folder_ / "out.h5").status(), "interrupted");
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

TEST_F(CommandTest, InfoTellsOfWhichNodesVectorsAre) {
  write_synthetic_run(folder_ / "run.h5", {});
  EXPECT_THAT(call("info " + (folder_ / "run.h5")).text, HasSubstr("deflection of nodes; nodes 1, 19, 20\n"));
  const auto json = nlohmann::json::parse(call("info --json " + (folder_ / "run.h5")).text);
  for (const auto& dataset : json["datasets"]) {
    if (dataset["path"] == "/flexible/chassis/deflection") {
      EXPECT_THAT(dataset["nodes"], ElementsAre("1", "19", "20"));
    }
  }
}

}  // namespace
}  // namespace wishbone
