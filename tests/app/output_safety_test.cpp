// What reaches the disk and what the shell is told, when a run is disturbed from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/call.h"
#include "app/small_run.h"
#include "solver/result_file.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return (std::ostringstream() << file.rdbuf()).str();
}

class OutputSafety : public testing::Test {
 protected:
  OutputSafety() {
    write_scene("short.yaml", "1 s");
    write_scene("long.yaml", "100000 s");
  }

  void write_scene(const std::string& name, const std::string& duration) {
    std::ofstream(folder_ / name)
        << "wishbone: 1\n"
           "bodies:\n"
           "  rod: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, -0.5]}\n"
           "joints:\n"
           "  pin: {type: revolute, bodies: [ground, rod], at: [0, 0, 0], axis: [0, 1, 0], "
           "position: 40 deg}\n"
           "analysis: {duration: "
        << duration << "}\n";
  }

  std::string run(const std::string& scene) const { return "run " + (folder_ / scene) + " -o " + out(); }
  std::string out() const { return folder_ / "out.h5"; }

  /// The long run in a process of its own, once its first rows are on the disk.
  pid_t start_long_run() const {
    std::fflush(stdout);
    const pid_t process = fork();
    if (process == 0) {
      const std::string scene = folder_ / "long.yaml", log = folder_ / "log";
      if (!freopen(log.c_str(), "w", stdout) || !freopen(log.c_str(), "w", stderr)) _exit(1);
      execl(WISHBONE_COMMAND, "wishbone", "run", scene.c_str(), "-o", out().c_str(), nullptr);
      _exit(1);
    }
    const auto start = std::chrono::steady_clock::now();
    while (rows() < 100 && std::chrono::steady_clock::now() - start < std::chrono::seconds(30))
      usleep(10'000);
    return process;
  }

  Eigen::Index rows() const {
    const std::string partial = out() + ".partial";
    return std::filesystem::exists(partial) ? ResultFile(partial).time().size() : 0;
  }

  static int code_of(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  TemporaryFolder folder_;
};

TEST_F(OutputSafety, SecondRunAtOneOutputIsRefusedAndHarmsNothing) {
  const pid_t first = start_long_run();
  const Answer second = call(run("short.yaml"));
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.text, AllOf(HasSubstr("another run is writing to this file"),
                                 HasSubstr("process " + std::to_string(first))));
  kill(first, SIGINT);
  EXPECT_EQ(code_of(first), 3);
  const ResultFile file(out());
  EXPECT_EQ(file.status(), "interrupted");
  EXPECT_GE(file.time().size(), 100);
}

TEST_F(OutputSafety, HangUpAndTerminationKeepEverything) {
  for (const int signal : {SIGHUP, SIGTERM}) {
    const pid_t process = start_long_run();
    kill(process, signal);
    EXPECT_EQ(code_of(process), 3);
    EXPECT_EQ(ResultFile(out()).status(), "interrupted");
    EXPECT_FALSE(std::filesystem::exists(out() + ".partial"));
    EXPECT_FALSE(std::filesystem::exists(out() + ".lock"));
  }
}

TEST_F(OutputSafety, KilledRunLeavesATableThatEveryCommandReadsAndTheNextRunStartsAnew) {
  const pid_t process = start_long_run();
  kill(process, SIGKILL);
  EXPECT_EQ(code_of(process), 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(out()));
  const Eigen::Index kept = rows();
  EXPECT_GE(kept, 100);
  EXPECT_THAT(call("info " + out() + ".partial").text, HasSubstr("running"));
  EXPECT_EQ(call("extract " + out() + ".partial -o " + (folder_ / "kept.h5")).code, 0);
  EXPECT_EQ(ResultFile(folder_ / "kept.h5").time().size(), kept);
  EXPECT_EQ(call("compare " + (folder_ / "kept.h5") + " " + out() + ".partial").code, 0);
  EXPECT_EQ(call(run("short.yaml")).code, 0);
  EXPECT_EQ(ResultFile(out()).status(), "complete");
}

/// The exit code of the command with redirections of its own, with which the pipe of call() would be in the way.
int code_with(const std::string& arguments, const std::string& redirections) {
  const int status =
      std::system((std::string(WISHBONE_COMMAND) + " " + arguments + " " + redirections).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST_F(OutputSafety, ClosedDescriptorsAreNotGivenToTheResults) {
  const std::vector<std::pair<std::string, int>> cases{
      {">/dev/null <&-", 0}, {">/dev/null 2>&-", 0}, {">&-", 3}, {">&- 2>&-", 3}, {"<&- >&- 2>&-", 3}};
  for (const auto& [redirections, code] : cases) {
    EXPECT_EQ(code_with(run("short.yaml"), redirections), code) << redirections;
    EXPECT_EQ(ResultFile(out()).time().size(), 101) << redirections;
  }
}

TEST_F(OutputSafety, StandardOutputThatCannotBeWrittenIsToldWithThree) {
  const std::string file = SmallRun().write(folder_ / "a.h5"), log = folder_ / "log";
  for (const std::string& command : {"info " + file, "info --json " + file, std::string("--help"),
                                     run("short.yaml"), "check " + file + " --against " + file}) {
    EXPECT_EQ(code_with(command, ">/dev/full 2>" + log), 3) << command;
    EXPECT_THAT(bytes(log), HasSubstr("no space left on device")) << command;
  }
  EXPECT_EQ(ResultFile(out()).status(), "complete");
  EXPECT_EQ(code_with("info " + file, ">/dev/full 2>/dev/full"), 3);
  EXPECT_EQ(code_with("info " + (folder_ / "absent"), "2>/dev/full"), 2);
  EXPECT_EQ(code_with(run("short.yaml"), ">/dev/null 2>/dev/full"), 0);  // there was nothing to tell
}

TEST_F(OutputSafety, FullDiskKeepsEarlierFilesOfEveryKind) {
  const std::string a = SmallRun().write(folder_ / "a.h5");
  const std::string full_at_512_bytes = "ulimit -f 1";
  for (const std::string& name : {std::string("out.h5"), std::string("r.html"), std::string("j.xml")})
    std::ofstream(folder_ / name) << "earlier";
  for (const std::string& command : {run("short.yaml"), "extract " + a + " -o " + out(),
                                     "compare " + a + " " + a + " --html " + (folder_ / "r.html")}) {
    const Answer answer = call(command, full_at_512_bytes);
    EXPECT_EQ(answer.code, 3) << command;
    EXPECT_THAT(answer.text, HasSubstr("file too large")) << command;
  }
  for (const std::string& name : {std::string("out.h5"), std::string("r.html"), std::string("j.xml")})
    EXPECT_EQ(bytes(folder_ / name), "earlier") << name;
  int leftovers = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / ""))
    leftovers += entry.path().string().find(".partial-") != std::string::npos ? 1 : 0;
  EXPECT_EQ(leftovers, 0);
}

TEST_F(OutputSafety, PipesDevicesAndFilesOfTheKernelAreRefusedAsInputs) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::vector<std::string> inputs{folder_ / "pipe", "/dev/zero", "/dev/stdin", "/proc/self/mountinfo"};
  if (access("/proc/kmsg", R_OK) == 0) inputs.push_back("/proc/kmsg");
  for (const std::string& input : inputs) {
    std::ofstream(folder_ / "includes.yaml") << "wishbone: 1\ninclude: ['" << input << "']\n";
    for (const std::string& command :
         {"run " + input + " -o " + out(), "info " + input, "convert " + input + " " + (folder_ / "x.unv"),
          "run " + (folder_ / "includes.yaml") + " -o " + out(), "identify " + input + " -o " + out()}) {
      const Answer answer = call(command + " </dev/null", "ulimit -t 20");
      EXPECT_EQ(answer.code, 2) << command << answer.text;
    }
  }
}

}  // namespace
}  // namespace wishbone
