#include "solver/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "allocation_counter.h"
#include "core/error.h"
#include "solver/result_file.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Signal> three_signals() {
  return {
      {"/bodies/chassis/position", {3}, "m", "world", "origin of the chassis", {}},
      {"/tires/front_left/deflection", {}, "m", "", "radial deflection", {}},
      {"/flexible/chassis/deflection", {2, 3}, "m", "chassis", "of the nodes", {{"nodes", {"19", "20"}}}}};
}

/// Row n holds 100 n, 100 n + 1, ..., 100 n + 9.
std::vector<double> row_of(int n) {
  std::vector<double> row(10);
  for (int i = 0; i < 10; ++i) row[static_cast<std::size_t>(i)] = 100.0 * n + i;
  return row;
}

void record(const std::string& path, int rows, const RecorderOptions& options = {}) {
  Recorder recorder(path, three_signals(), options);
  for (int n = 0; n < rows; ++n) recorder.append(0.005 * n, row_of(n));
  recorder.set_meta("scene", "name: test\n");
  recorder.set_run_meta("wall_time", 1.0);
  recorder.close(Outcome::kComplete);
}

/// The signals hold what row_of gave, row by row.
void expect_rows(const ResultFile& file) {
  const MatrixX position = file.read("/bodies/chassis/position");
  const MatrixX tire = file.read("/tires/front_left/deflection");
  const MatrixX deflection = file.read("/flexible/chassis/deflection");
  for (int n = 0; n < file.time().size(); ++n) {
    const std::vector<double> row = row_of(n);
    ASSERT_EQ(file.time()[n], 0.005 * n);
    ASSERT_EQ(position.row(n), Eigen::RowVector3d(row[0], row[1], row[2]));
    ASSERT_EQ(tire(n, 0), row[3]);
    for (int i = 0; i < 6; ++i) ASSERT_EQ(deflection(n, i), row[4 + static_cast<std::size_t>(i)]);
  }
}

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return (std::ostringstream() << file.rdbuf()).str();
}

TEST(Recorder, RowsComeBackWhetherOrNotTheyFillTheLastChunk) {
  const TemporaryFolder folder;
  for (const int rows : {0, 1, 7, 8, 9, 16, 401}) {
    record(folder / "a.h5", rows, {.chunk_rows = 8});
    const ResultFile file(folder / "a.h5");
    ASSERT_EQ(file.time().size(), rows);
    expect_rows(file);
    EXPECT_EQ(file.status(), "complete");
  }
}

TEST(Recorder, EverySignalSaysUnitsFrameAndMeaning) {
  const TemporaryFolder folder;
  record(folder / "a.h5", 3);
  const hdf5::FileReader file(folder / "a.h5");
  for (const std::string& path : file.dataset_paths())
    for (const char* name : {"units", "frame", "about"})
      EXPECT_TRUE(file.open_dataset(path).has_attribute(name)) << path;
  const hdf5::DatasetReader deflection = file.open_dataset("/flexible/chassis/deflection");
  EXPECT_EQ(deflection.text_attribute("units"), "m");
  EXPECT_EQ(deflection.text_attribute("frame"), "chassis");
  EXPECT_EQ(file.open_dataset("/time").text_attribute("units"), "s");
  EXPECT_THAT(std::get<std::vector<std::string>>(deflection.attribute("nodes")), ElementsAre("19", "20"));
}

// The reader is HDF5's own tool, which knows nothing of the Recorder.
TEST(Recorder, OtherProgramsSeeTheTimeScaleAndTheCompression) {
  const TemporaryFolder folder;
  record(folder / "a.h5", 300);
  const std::string command = "h5dump -p -H " + (folder / "a.h5") + " > " + (folder / "dump.txt");
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string dump = bytes(folder / "dump.txt");
  EXPECT_THAT(dump, HasSubstr("ATTRIBUTE \"DIMENSION_LIST\""));
  EXPECT_THAT(dump, HasSubstr("ATTRIBUTE \"REFERENCE_LIST\""));
  EXPECT_THAT(dump, HasSubstr("PREPROCESSING SHUFFLE"));
  EXPECT_THAT(dump, HasSubstr("COMPRESSION DEFLATE { LEVEL 4 }"));
  EXPECT_THAT(dump, HasSubstr("CHUNKED ( 256, 2, 3 )"));
  EXPECT_THAT(dump, HasSubstr("( 300, 3 ) / ( H5S_UNLIMITED, 3 )"));
}

TEST(Recorder, EqualRunsGiveEqualFiles) {
  const TemporaryFolder folder;
  record(folder / "a.h5", 1000);
  usleep(1'100'000);  // time stamps would count seconds
  record(folder / "b.h5", 1000);
  EXPECT_EQ(std::system(("h5diff " + (folder / "a.h5") + " " + (folder / "b.h5")).c_str()), 0);
  EXPECT_EQ(bytes(folder / "a.h5"), bytes(folder / "b.h5"));
}

TEST(Recorder, FileHasItsNameOnlyWhenItIsClosed) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  Recorder recorder(path, three_signals());
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::exists(path + ".partial"));
  recorder.append(0, row_of(0));
  recorder.close(Outcome::kFailed, "step size below minimum at t = 0.1 s");
  EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
  const ResultFile file(path);
  EXPECT_EQ(file.status(), "failed: step size below minimum at t = 0.1 s");
  EXPECT_EQ(file.time().size(), 1);
}

TEST(Recorder, LeavingTheScopeCountsAsInterruption) {
  const TemporaryFolder folder;
  {
    Recorder recorder(folder / "a.h5", three_signals());
    recorder.append(0, row_of(0));
  }
  const ResultFile file(folder / "a.h5");
  EXPECT_EQ(file.status(), "interrupted");
  EXPECT_EQ(file.time().size(), 1);
}

/// A process of its own that records row after row without end, and tells through a pipe the rows it has
/// committed.
class Writer {
 public:
  Writer(const std::string& path, int chunk_rows) {
    if (pipe(channel_) != 0) throw std::runtime_error("pipe");
    process_ = fork();
    if (process_ != 0) return;
    Recorder recorder(path, three_signals(), {.chunk_rows = chunk_rows});
    for (int n = 0;; ++n) {
      recorder.append(0.005 * n, row_of(n));
      if (recorder.rows() % chunk_rows != 0) continue;
      const long rows = recorder.rows();
      if (::write(channel_[1], &rows, sizeof rows) != sizeof rows) _exit(1);
      usleep(300);  // a solver would be computing now
    }
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Waits for the first commit and `delay` more, kills the process; returns the rows of the last commit
  /// told.
  long kill_after(useconds_t delay) {
    long rows = 0;
    long last = 0;
    if (::read(channel_[0], &last, sizeof last) != sizeof last) return -1;
    usleep(delay);
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    ::close(channel_[1]);
    while (::read(channel_[0], &rows, sizeof rows) == sizeof rows) last = rows;
    ::close(channel_[0]);
    return last;
  }

 private:
  int channel_[2];
  pid_t process_;
};

TEST(Recorder, EverythingCommittedSurvivesSigkillAtAnyMoment) {
  const TemporaryFolder folder;
  const char* wanted = std::getenv("WISHBONE_TEST_KILLS");
  const int kills = wanted ? std::atoi(wanted) : 20;
  for (int i = 0; i < kills; ++i) {
    const std::string path = folder / ("killed" + std::to_string(i) + ".h5");
    const long told = Writer(path, 16).kill_after(static_cast<useconds_t>(7919 * i % 30'000));
    ASSERT_FALSE(std::filesystem::exists(path));
    const ResultFile file(path + ".partial");
    EXPECT_EQ(file.status(), "running");
    EXPECT_GE(file.time().size(), told);
    expect_rows(file);
  }
}

TEST(Recorder, FullDiskIsReportedAndKeepsTheProgramAlive) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      Recorder recorder(folder / "a.h5", three_signals(), {.chunk_rows = 64, .deflate_level = 0});
      for (int n = 0; n < 100'000; ++n) recorder.append(0.005 * n, row_of(n));
    } catch (const NumericsError& e) {
      code = std::string(e.what()).find("File too large") != std::string::npos ? 42 : 2;
    }
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

TEST(Recorder, AppendAllocatesNothingBetweenCommits) {
  const TemporaryFolder folder;
  Recorder recorder(folder / "a.h5", three_signals(), {.chunk_rows = 128});
  const std::vector<double> row = row_of(1);
  const long before = allocation_count();
  for (int n = 0; n < 127; ++n) recorder.append(0.005 * n, row);
  EXPECT_EQ(allocation_count() - before, 0);
}

TEST(Recorder, RowsThatDoNotFitAreRefused) {
  const TemporaryFolder folder;
  Recorder recorder(folder / "a.h5", three_signals());
  EXPECT_THROW(recorder.append(0, std::vector<double>(9)), InputError);
  recorder.append(1, row_of(0));
  recorder.append(1, row_of(1));  // both sides of a jump
  EXPECT_THROW(recorder.append(0.5, row_of(2)), NumericsError);
  EXPECT_THROW(recorder.append(NAN, row_of(2)), NumericsError);
  EXPECT_EQ(recorder.rows(), 2);
}

TEST(Recorder, SignalPathsMustBeAbsoluteAndDistinct) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& paths :
       {std::vector<std::string>{"x"}, {"/time"}, {"/meta/x"}, {"/a", "/a"}, {""}}) {
    std::vector<Signal> signals;
    for (const std::string& path : paths) signals.push_back({path, {}, "m", "", "", {}});
    EXPECT_THROW(Recorder(folder / "a.h5", signals), InputError) << paths.back();
  }
}

}  // namespace
}  // namespace wishbone
