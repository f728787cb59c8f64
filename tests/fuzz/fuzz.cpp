#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/hdf5.h"
#include "fuzz/mutated_bytes.h"
#include "fuzz/readers.h"

/// Gives mutated files to every reader: each must read or refuse with an InputError that names a place, within 2 s of processor
/// time and 512 MB. Everything else is a fault, told with the seed that repeats it:
///
///     wishbone_fuzz COUNT [FIRST_SEED [JOBS]]        seeds FIRST_SEED to FIRST_SEED + COUNT - 1
///     wishbone_fuzz --show SEED                      writes the input of that seed to standard output
///
/// A worker process reads; when it dies, the input that it had is a fault, and another goes on behind it.
namespace wishbone::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double kLongest = 2;                   // [s]
constexpr std::size_t kMostMemory = 512u << 20;  // [bytes]
constexpr std::size_t kMostReaders = 16;
constexpr unsigned kWallSeconds = 60;  // sleeping forever takes no processor time

/// What worker and parent share.
struct Tally {
  unsigned long seed;
  unsigned long read[kMostReaders], refused[kMostReaders], faults[kMostReaders];
  double longest[kMostReaders];
  long most_memory;  // [kB]
};

// A sanitizer takes terabytes of address space, so that the processes that read HDF5 (IsolatedProcess) have no limit on it there:
// what they take is then no fault of a reader.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryOfChildrenCounts = false;
#else
constexpr bool kMemoryOfChildrenCounts = true;
#endif

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// Processor time [s] of this process and of its children that have ended.
double processor_time() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage;
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

long peak_memory_of(int who) {
  rusage usage;
  getrusage(who, &usage);
  return usage.ru_maxrss;
}

/// Largest memory of this process or one of its children [kB].
long peak_memory() {
  const long own = peak_memory_of(RUSAGE_SELF);
  return kMemoryOfChildrenCounts ? std::max(own, peak_memory_of(RUSAGE_CHILDREN)) : own;
}

void limit_processor_time(double limit) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(limit);
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(limit > 0 ? kWallSeconds : 0);
}

class Fuzz {
 public:
  explicit Fuzz(const fs::path& folder) : readers_(readers(folder)) {
    for (std::size_t i = 0; i < readers_.size(); ++i) order_.insert(order_.end(), readers_[i].share, i);
  }

  std::size_t reader_of(unsigned long seed) const { return order_[seed % order_.size()]; }
  const std::vector<Reader>& all() const { return readers_; }

  /// The file of this seed, and what is in it.
  std::pair<const Input*, std::string> input_of(unsigned long seed) const {
    std::mt19937_64 random(seed);
    const std::vector<Input>& inputs = readers_[reader_of(seed)].inputs;
    const Input& input = inputs[random() % inputs.size()];
    return {&input, mutated(input.bytes, random)};
  }

  void try_seed(unsigned long seed, Tally& tally) const {
    const std::size_t reader = reader_of(seed);
    const auto [input, bytes] = input_of(seed);
    std::ofstream(input->file, std::ios::binary) << bytes;
    const double start = processor_time();
    limit_processor_time(kLongest);
    const std::string fault = read(*input, tally.read[reader], tally.refused[reader]);
    limit_processor_time(0);
    const double taken = processor_time() - start;
    std::ofstream(input->file, std::ios::binary) << input->bytes;
    tally.longest[reader] = std::max(tally.longest[reader], taken);
    if (!fault.empty())
      report(seed, fault, tally);
    else if (taken > kLongest)
      report(seed, fmt::format("took {:.1f} s", taken), tally);
  }

  void report(unsigned long seed, const std::string& fault, Tally& tally) const {
    ++tally.faults[reader_of(seed)];
    fmt::print(stderr, "seed {} ({}, {}): {}\n", seed, readers_[reader_of(seed)].name,
               input_of(seed).first->file.filename().string(), fault);
  }

 private:
  /// What is wrong with the way the reader took it; empty: nothing.
  static std::string read(const Input& input, unsigned long& read, unsigned long& refused) {
    try {
      input.read();
      ++read;
    } catch (const InputError& e) {
      ++refused;
      if (e.diagnostic().where.empty()) return std::string("an error without a place: ") + e.what();
    } catch (const std::exception& e) {
      return std::string("another exception: ") + e.what();
    }
    return {};
  }

  std::vector<Reader> readers_;
  std::vector<std::size_t> order_;
};

struct Range {
  unsigned long first, end, step;
};

[[noreturn]] void work(const Fuzz& fuzz, const Range& range, Tally& tally) {
  for (tally.seed = range.first; tally.seed < range.end; tally.seed += range.step) {
    fuzz.try_seed(tally.seed, tally);
    tally.most_memory = std::max(tally.most_memory, peak_memory());
    if (static_cast<std::size_t>(peak_memory()) * 1024 > kMostMemory) {
      fuzz.report(tally.seed, fmt::format("took {} MB", peak_memory() / 1024), tally);
      tally.seed += range.step;
      _exit(0);  // the peak never falls
    }
  }
  _exit(0);
}

Tally* shared_tally() {
  void* memory = mmap(nullptr, sizeof(Tally), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return new (memory) Tally{};
}

/// One worker after the other until the range is done.
Tally* supervise(Range range) {
  std::string folder = (fs::temp_directory_path() / "wishbone-fuzz-XXXXXX").string();
  if (!mkdtemp(folder.data())) throw std::runtime_error("cannot make a folder");
  Tally* tally = shared_tally();
  {
    const Fuzz fuzz(folder);
    while (range.first < range.end) {
      tally->seed = range.first;
      const pid_t worker = fork();
      if (worker == 0) work(fuzz, range, *tally);
      int status = 0;
      waitpid(worker, &status, 0);
      range.first = tally->seed;
      if (status == 0) continue;
      fuzz.report(
          range.first,
          WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : fmt::format("exit {}", WEXITSTATUS(status)),
          *tally);
      range.first += range.step;
    }
  }
  fs::remove_all(folder);
  return tally;
}

int print(const std::vector<Tally*>& tallies, const std::vector<Reader>& readers) {
  unsigned long inputs = 0, all_faults = 0;
  long memory = 0;
  fmt::print("{:16}{:>10}{:>10}{:>8}{:>12}\n", "reader", "read", "refused", "faults", "longest [s]");
  for (std::size_t i = 0; i < readers.size(); ++i) {
    unsigned long read = 0, refused = 0, faults = 0;
    double longest = 0;
    for (const Tally* tally : tallies) {
      read += tally->read[i];
      refused += tally->refused[i];
      faults += tally->faults[i];
      longest = std::max(longest, tally->longest[i]);
      memory = std::max(memory, tally->most_memory);
    }
    fmt::print("{:16}{:10}{:10}{:8}{:12.2f}\n", readers[i].name, read, refused, faults, longest);
    inputs += read + refused;
    all_faults += faults;
  }
  fmt::print("{} inputs read or refused, {} faults, at most {} MB\n", inputs, all_faults, memory / 1024);
  return all_faults == 0 ? 0 : 1;
}

int run(const std::vector<unsigned long>& numbers) {
  const unsigned long count = numbers.at(0), first = numbers.size() > 1 ? numbers[1] : 1;
  const unsigned long jobs = numbers.size() > 2 ? numbers[2] : 1;
  std::vector<Tally*> tallies;
  std::vector<pid_t> supervisors;
  for (unsigned long job = 0; job < jobs; ++job) {
    tallies.push_back(shared_tally());
    supervisors.push_back(fork());
    if (supervisors.back() == 0) {
      *tallies.back() = *supervise({first + job, first + count, jobs});
      _exit(0);
    }
  }
  for (const pid_t supervisor : supervisors) waitpid(supervisor, nullptr, 0);
  std::string folder = (fs::temp_directory_path() / "wishbone-fuzz-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 1;
  const std::vector<Reader> names = readers(folder);
  fs::remove_all(folder);
  return print(tallies, names);
}

}  // namespace
}  // namespace wishbone::fuzz

int main(int argc, char** argv) {
  using namespace wishbone::fuzz;
  wishbone::hdf5::leave_out_exit_handler();
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool show = arguments.size() == 2 && arguments[0] == "--show";
  if (show) arguments.erase(arguments.begin());
  std::vector<unsigned long> numbers;
  for (const std::string& argument : arguments) {
    unsigned long& number = numbers.emplace_back();
    const char* end = argument.data() + argument.size();
    if (std::from_chars(argument.data(), end, number) != std::from_chars_result{end, {}}) {
      numbers.clear();
      break;
    }
  }
  if (numbers.empty() || numbers.size() > 3) {
    fmt::print(stderr, "usage: wishbone_fuzz COUNT [FIRST_SEED [JOBS]], or --show SEED\n");
    return 2;
  }
  if (!show) return run(numbers);
  std::string folder = (std::filesystem::temp_directory_path() / "wishbone-fuzz-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 1;
  const std::string bytes = Fuzz(folder).input_of(numbers[0]).second;
  fwrite(bytes.data(), 1, bytes.size(), stdout);
  std::filesystem::remove_all(folder);
  return 0;
}
