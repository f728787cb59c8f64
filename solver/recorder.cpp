#include "solver/recorder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/partial_file.h"
#include "solver/result_layout.h"

namespace wishbone {

namespace {

void check_signals(const std::string& path, const std::vector<Signal>& signals) {
  std::set<std::string> taken;
  for (const Signal& signal : signals) {
    const std::string where = path + ":" + signal.path;
    if (!signal.path.starts_with('/') || signal.path.size() < 2 || ResultLayout::is_reserved(signal.path))
      throw InputError(
          {where, "a signal needs an absolute path outside /meta", signal.path, "name it /group/name"});
    if (!taken.insert(signal.path).second)
      throw InputError({where, "this path is taken", signal.path, "give every signal a path of its own"});
    if (signal.size() < 1) throw InputError({where, "a signal has at least one number a row", "", ""});
  }
}

/// Rows to make room for: those expected, or 64 KiB when nobody knows.
std::size_t room_for(const RecorderOptions& options, std::size_t row_length) {
  constexpr double kMostRows = 1e8;
  const auto expected = static_cast<std::size_t>(std::min(options.expected_rows, kMostRows));
  return expected > 0 ? expected : 1 + (std::size_t{1} << 13) / (row_length + 1);
}

std::size_t length_of(const std::vector<Signal>& signals) {
  std::size_t length = 0;
  for (const Signal& signal : signals) length += static_cast<std::size_t>(signal.size());
  return length;
}

/// Deletes what runs with this output that were killed have left under names of the moment (PartialFile).
OutputLock without_leftovers(OutputLock output) {
  const std::filesystem::path path(output.path());
  const std::string name = path.filename().string();
  std::error_code unknown;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(
           path.has_parent_path() ? path.parent_path() : std::filesystem::path("."), unknown)) {
    const std::string other = entry.path().filename().string();
    if (PartialFile::is_name_of(other, name) || PartialFile::is_name_of(other, name + ".partial"))
      leftovers.push_back(entry.path());
  }
  for (const std::filesystem::path& leftover : leftovers) std::filesystem::remove(leftover, unknown);
  return output;
}

std::string status_text(Outcome outcome, std::string_view why) {
  switch (outcome) {
    case Outcome::kComplete:
      return "complete";
    case Outcome::kInterrupted:
      return "interrupted";
    case Outcome::kFailed:
      return fmt::format("failed: {}", why);
  }
  return "unknown";
}

}  // namespace

int Signal::size() const {
  return std::accumulate(shape.begin(), shape.end(), 1, std::multiplies<>());
}

Recorder::Recorder(OutputLock output, std::vector<Signal> signals, const RecorderOptions& options)
    : output_(without_leftovers(std::move(output))),
      signals_((check_signals(output_.path(), signals), std::move(signals))),
      storage_{static_cast<std::size_t>(options.chunk_rows), static_cast<unsigned>(options.deflate_level)},
      row_length_(length_of(signals_)),
      table_(output_.path(), signals_, room_for(options, row_length_), options.commit_seconds),
      last_time_(-std::numeric_limits<double>::infinity()) {}

Recorder::~Recorder() {
  if (!open_) return;
  try {
    close(Outcome::kInterrupted);
  } catch (const Error&) {
    // A destructor may not throw; the rows stay in the table.
  }
}

/// Does what may fail for want of room, and says then what is safe.
template <class Write>
void Recorder::write(Write&& write) {
  try {
    write();
  } catch (const NumericsError& e) {
    open_ = false;
    Diagnostic diagnostic = e.diagnostic();
    diagnostic.remedy = fmt::format(
        "{} of {} rows are safe in {}; with room, `wishbone extract {} -o FILE.h5` makes a results file of "
        "them",
        table_.committed_rows(), rows_, table_.name(), table_.name());
    throw NumericsError(std::move(diagnostic));
  }
}

void Recorder::append(double time, std::span<const double> row) {
  if (row.size() != row_length_)
    throw InputError({output_.path(), "a row must hold the numbers of all signals",
                      fmt::format("{}", row.size()), fmt::format("{} are expected", row_length_)});
  if (!(std::isfinite(time) && time >= last_time_))
    throw NumericsError({fmt::format("{}: row {}", output_.path(), rows_),
                         "time runs backwards or is not finite",
                         fmt::format("{} s after {} s", time, last_time_), ""});
  last_time_ = time;
  ++rows_;
  write([&] { table_.append(time, row); });
}

void Recorder::set_meta(const std::string& name, const hdf5::Value& value) {
  facts_.meta[name] = value;
}

void Recorder::set_run_meta(const std::string& name, const hdf5::Value& value) {
  facts_.run[name] = value;
}

void Recorder::close(Outcome outcome, std::string_view why) {
  open_ = false;
  set_meta("status", status_text(outcome, why));
  write([&] {
    table_.commit();
    write_results(output_.path(), signals_, table_, facts_, storage_);
  });
  table_.remove();
}

}  // namespace wishbone
