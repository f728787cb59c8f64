#include "solver/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
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

/// Whether the shell finds a program or a module of Python's.
bool there_is(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

// The readers are programs of others.
TEST(Recorder, NetcdfToolsFindDimensionsAndUnits) {
  if (!there_is("which ncdump")) GTEST_SKIP() << "ncdump (netcdf-bin) is not installed";
  const TemporaryFolder folder;
  record(folder / "a.h5", 300);
  ASSERT_EQ(std::system(("ncdump -h " + (folder / "a.h5") + " > " + (folder / "dump.txt")).c_str()), 0);
  const std::string dump = bytes(folder / "dump.txt");
  for (const char* line :
       {"time = UNLIMITED ; // (300 currently)", "component_3 = 3 ;", "vector_2 = 2 ;", "double time(time)",
        "double position(time, component_3)", "double deflection(time, vector_2, component_3)",
        "string position:units = \"m\"", "string time:units = \"s\""})
    EXPECT_THAT(dump, HasSubstr(line));
}

TEST(Recorder, XarrayReadsSignalsWithDimensionsAndUnits) {
  const std::string python = "/usr/bin/python3";
  if (!there_is(python + " -c 'import xarray, h5netcdf'"))
    GTEST_SKIP() << "python3-xarray or python3-h5netcdf is not installed";
  const TemporaryFolder folder;
  record(folder / "a.h5", 300);
  std::ofstream(folder / "read.py") << "import sys, xarray\n"
                                       "open = lambda group: xarray.open_dataset(sys.argv[1], "
                                       "engine='h5netcdf', group=group, decode_times=False)\n"
                                       "p = open('bodies/chassis').position\n"
                                       "d = open('flexible/chassis').deflection\n"
                                       "assert p.dims == ('time', 'component_3'), p.dims\n"
                                       "assert d.dims == ('time', 'vector_2', 'component_3'), d.dims\n"
                                       "assert p.units == 'm' and d.shape == (300, 2, 3)\n"
                                       "assert float(p[299, 2]) == 29902\n";
  EXPECT_EQ(std::system((python + " " + (folder / "read.py") + " " + (folder / "a.h5")).c_str()), 0);
}

TEST(Recorder, ThousandsOfSignalsHangOnOneTimeScale) {
  const TemporaryFolder folder;
  std::vector<Signal>
      signals;  // 16 bytes each in the list of the scale: beyond the 64 KiB of an attribute in a header
  for (int i = 0; i < 4200; ++i) signals.push_back({"/loads/n" + std::to_string(i), {}, "N", "", "", {}});
  std::vector<double> row(signals.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<double>(i);
  {
    Recorder recorder(folder / "a.h5", signals);
    for (int n = 0; n < 3; ++n) recorder.append(n, row);
    recorder.close(Outcome::kComplete);
  }
  const ResultFile file(folder / "a.h5");
  EXPECT_EQ(file.signals().size(), signals.size());
  EXPECT_EQ(file.read("/loads/n4199")(2, 0), 4199);
  if (there_is("which ncdump")) {
    EXPECT_TRUE(there_is("ncdump -h " + (folder / "a.h5") + " | grep -q 'double n4199(time)'"));
  }
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

/// A process of its own that records row after row without end, and tells through a pipe how many `append` has taken.
class Writer {
 public:
  Writer(const std::string& path, const RecorderOptions& options) {
    if (pipe(channel_) != 0) throw std::runtime_error("pipe");
    process_ = fork();
    if (process_ != 0) return;
    Recorder recorder(path, three_signals(), options);
    for (int n = 0;; ++n) {
      recorder.append(0.005 * n, row_of(n));
      const long rows = recorder.rows();
      if (::write(channel_[1], &rows, sizeof rows) != sizeof rows) _exit(1);
    }
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  pid_t process() const { return process_; }
  /// The next number of rows that the writer tells.
  long told() {
    long rows = 0;
    return ::read(channel_[0], &rows, sizeof rows) == sizeof rows ? rows : -1;
  }
  /// Kills the writer; the last number of rows that it told.
  long end() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    ::close(channel_[1]);
    long last = 0;
    for (long rows = told(); rows > 0; rows = told()) last = rows;
    ::close(channel_[0]);
    return last;
  }

 private:
  int channel_[2];
  pid_t process_;
};

/// h5dump knows nothing of the Recorder.
bool opens_in_h5dump(const std::string& path) {
  return std::system(("h5dump -d /meta/rows -d /time -c 1 " + path + " > /dev/null 2>&1").c_str()) == 0;
}

TEST(Recorder, KillAtAnyMomentLeavesNoFileOrOneWithEveryRowCommitted) {
  const TemporaryFolder folder;
  const char* wanted = std::getenv("WISHBONE_TEST_KILLS");
  const int kills = wanted ? std::atoi(wanted) : 20;
  for (int i = 0; i < kills; ++i) {
    const std::string path = folder / ("killed" + std::to_string(i) + ".h5");
    // from before the file is made to after it has been copied to one with more room several times
    Writer writer(path, {.expected_rows = 4, .commit_seconds = 0});
    usleep(static_cast<useconds_t>(7919 * i % 60'000));
    const long told = writer.end();
    ASSERT_FALSE(std::filesystem::exists(path));
    if (!std::filesystem::exists(path + ".partial")) {
      EXPECT_EQ(told, 0);
      continue;
    }
    EXPECT_TRUE(opens_in_h5dump(path + ".partial"));
    const ResultFile file(path + ".partial");
    EXPECT_EQ(file.status(), "running");
    EXPECT_GE(file.time().size(), told);
    expect_rows(file);
  }
}

TEST(Recorder, KillLosesNoRowOlderThanTheTimeBetweenCommits) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  Writer writer(path, {.commit_seconds = 0.05});
  long before = 0;
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(300)) before = writer.told();
  const auto asked = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - asked < std::chrono::milliseconds(500)) writer.told();
  writer.end();
  const ResultFile file(path + ".partial");
  EXPECT_GE(file.time().size(), before);
  expect_rows(file);
}

TEST(Recorder, SecondWriterOfOneFileIsRefusedAndTheFirstGoesOn) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  Writer writer(path, {});
  ASSERT_GE(writer.told(), 1);
  try {
    Recorder second(path, three_signals());
    ADD_FAILURE() << "two writers";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr(std::to_string(writer.process())));
  }
  EXPECT_GT(writer.told(), 0);
  writer.end();
  EXPECT_TRUE(std::filesystem::exists(path + ".lock"));
  record(path, 3);  // the lock of the dead is nobody's
  EXPECT_FALSE(std::filesystem::exists(path + ".lock"));
  EXPECT_EQ(ResultFile(path).time().size(), 3);
}

TEST(Recorder, RemovesWhatKilledWritersOfTheSameFileLeft) {
  const TemporaryFolder folder;
  for (const char* name : {"a.h5.partial-0a1b2c", "a.h5.partial.partial-0a1b2c", "b.h5.partial-0a1b2c"})
    std::ofstream(folder / name) << "left";
  record(folder / "a.h5", 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.partial-0a1b2c"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.partial.partial-0a1b2c"));
  EXPECT_TRUE(std::filesystem::exists(folder / "b.h5.partial-0a1b2c"));
}

TEST(Recorder, LeavesFilesAloneWhoseNamesOnlyBeginLikeItsOwn) {
  const TemporaryFolder folder;
  const std::vector<std::string> names{
      "a.h5.partial-notes",   "a.h5.partial-backup",   "a.h5.partial-0a1b2",
      "a.h5.partial-0a1b2c3", "a.h5.partial-0A1B2C",   "a.h5.partial-",
      "a.h5.partial-0a1b2c~", "a.h5.partial.partial-", "xa.h5.partial-0a1b2c"};
  for (const std::string& name : names) std::ofstream(folder / name) << "kept";
  record(folder / "a.h5", 3);
  for (const std::string& name : names) EXPECT_EQ(bytes(folder / name), "kept") << name;
}

TEST(Recorder, DevicesPipesAndFoldersAreNotReplaced) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "device");  // never by its own name: it can be lost
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "folder");
  std::filesystem::create_symlink(folder / "folder", folder / "way");
  for (const char* name : {"device", "pipe", "folder", "way"}) {
    EXPECT_THROW(record(folder / name, 3), NumericsError) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / (std::string(name) + ".lock"))) << name;
    std::filesystem::create_symlink(folder / name, folder / "a.h5.partial");
    EXPECT_THROW(record(folder / "a.h5", 3), NumericsError) << name;
    std::filesystem::remove(folder / "a.h5.partial");
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "device"));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  const auto left = std::filesystem::directory_iterator(folder / "");
  EXPECT_EQ(std::distance(begin(left), end(left)), 4);
}

TEST(Recorder, LinkWithTheNameOfThePartialFileIsNotFollowed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "precious") << "precious";
  for (const char* ending : {".partial", ".lock"}) {
    const std::string link = folder / ("a.h5" + std::string(ending));
    std::filesystem::create_symlink(folder / "precious", link);
    try {
      record(folder / "a.h5", 3);
    } catch (const NumericsError&) {
      EXPECT_STREQ(ending, ".lock");
    }
    EXPECT_EQ(bytes(folder / "precious"), "precious");
    std::filesystem::remove(link);
  }
}

/// Records without end in a process that may write so many bytes to a file; its last words.
std::string last_words_within(rlim_t bytes, const std::string& path) {
  int channel[2];
  if (pipe(channel) != 0) throw std::runtime_error("pipe");
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      Recorder recorder(path, three_signals(), {.expected_rows = 64, .commit_seconds = 0});
      for (int n = 0; n < 100'000; ++n) recorder.append(0.005 * n, row_of(n));
    } catch (const NumericsError& e) {
      if (::write(channel[1], e.what(), std::strlen(e.what())) < 0) _exit(1);
    }
    _exit(0);
  }
  ::close(channel[1]);
  std::string words(4096, '\0');
  words.resize(
      static_cast<std::size_t>(std::max<ssize_t>(0, ::read(channel[0], words.data(), words.size()))));
  ::close(channel[0]);
  waitpid(child, nullptr, 0);
  return words;
}

TEST(Recorder, FullDiskIsReportedAndKeepsWhatWasSafe) {
  const TemporaryFolder folder;
  int kept = 0;
  for (rlim_t bytes = 1000; bytes < 200'000; bytes = bytes * 13 / 8) {
    const std::string path = folder / ("full" + std::to_string(bytes) + ".h5");
    EXPECT_THAT(last_words_within(bytes, path), HasSubstr("file too large")) << bytes;
    EXPECT_FALSE(std::filesystem::exists(path));
    if (!std::filesystem::exists(path + ".partial")) continue;
    EXPECT_TRUE(opens_in_h5dump(path + ".partial"));
    const ResultFile file(path + ".partial");
    EXPECT_GE(file.time().size(), 64);
    expect_rows(file);
    ++kept;
  }
  EXPECT_GE(kept, 3);
}

TEST(Recorder, FileDoesNotDependOnWhenItsRowsWereCommitted) {
  const TemporaryFolder folder;
  record(folder / "a.h5", 1000, {.expected_rows = 1000, .commit_seconds = 100});
  record(folder / "b.h5", 1000, {.expected_rows = 3, .commit_seconds = 0});
  EXPECT_EQ(bytes(folder / "a.h5"), bytes(folder / "b.h5"));
}

TEST(Recorder, AppendAllocatesNothingBetweenCommits) {
  const TemporaryFolder folder;
  Recorder recorder(folder / "a.h5", three_signals(), {.expected_rows = 200, .commit_seconds = 100});
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
