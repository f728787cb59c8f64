#include "solver/recorder.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "core/error.h"

namespace wishbone {

namespace {

std::string partial(const std::string& path) {
  return path + ".partial";
}

void check_signals(const std::string& path, const std::vector<Signal>& signals) {
  std::set<std::string> taken{"/time", "/meta"};
  for (const Signal& signal : signals) {
    const std::string where = path + ":" + signal.path;
    if (!signal.path.starts_with('/') || signal.path.size() < 2 || signal.path.starts_with("/meta/"))
      throw InputError(
          {where, "a signal needs an absolute path outside /meta", signal.path, "name it /group/name"});
    if (!taken.insert(signal.path).second)
      throw InputError({where, "this path is taken", signal.path, "give every signal a path of its own"});
    if (signal.size() < 1) throw InputError({where, "a signal has at least one number a row", "", ""});
  }
}

hdf5::Dataset create_time(hdf5::File& file, const hdf5::SeriesStorage& storage) {
  hdf5::Dataset time = file.create_series("/time", {}, storage);
  time.set_attribute("units", "s");
  time.set_attribute("frame", "");
  time.set_attribute("about", "time of each row");
  time.make_scale("time");
  return time;
}

hdf5::Dataset create_row_count(hdf5::File& file) {
  const double none = 0;
  hdf5::Dataset rows = file.write("/meta/rows", {}, {&none, 1});
  rows.set_attribute("units", "1");
  rows.set_attribute("frame", "");
  rows.set_attribute("about", "number of rows that are good; what lies beyond is to be ignored");
  return rows;
}

hdf5::Dataset create_signal(hdf5::File& file, const Signal& signal, const hdf5::Dataset& time,
                            const hdf5::SeriesStorage& storage) {
  hdf5::Dataset dataset =
      file.create_series(signal.path, {signal.shape.begin(), signal.shape.end()}, storage);
  dataset.set_attribute("units", signal.units);
  dataset.set_attribute("frame", signal.frame);
  dataset.set_attribute("about", signal.about);
  for (const auto& [name, texts] : signal.lists) dataset.set_attribute(name, texts);
  dataset.attach_scale(time);
  return dataset;
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

Recorder::Recorder(std::string path, std::vector<Signal> signals, const RecorderOptions& options)
    : path_((check_signals(path, signals), std::move(path))),
      signals_(std::move(signals)),
      chunk_rows_(static_cast<std::size_t>(options.chunk_rows)),
      file_(hdf5::File::create(partial(path_))),
      meta_(file_.create_group("/meta")),
      run_meta_(file_.create_group("/meta/run")),
      time_(create_time(file_, {chunk_rows_, static_cast<unsigned>(options.deflate_level)})),
      committed_rows_(create_row_count(file_)),
      last_time_(-std::numeric_limits<double>::infinity()) {
  set_meta("status", "running");
  time_buffer_.reserve(chunk_rows_);
  for (const Signal& signal : signals_) {
    datasets_.push_back(
        create_signal(file_, signal, time_, {chunk_rows_, static_cast<unsigned>(options.deflate_level)}));
    row_length_ += static_cast<std::size_t>(signal.size());
    buffers_.emplace_back().reserve(chunk_rows_ * static_cast<std::size_t>(signal.size()));
  }
  file_.flush();
}

Recorder::~Recorder() {
  if (!open_) return;
  try {
    close(Outcome::kInterrupted);
  } catch (const Error&) {
    // A destructor may not throw; what was committed stays in the partial file.
  }
}

void Recorder::append(double time, std::span<const double> row) {
  if (row.size() != row_length_)
    throw InputError({path_, "a row must hold the numbers of all signals", fmt::format("{}", row.size()),
                      fmt::format("{} are expected", row_length_)});
  if (!(std::isfinite(time) && time >= last_time_))
    throw NumericsError({fmt::format("{}: row {}", path_, rows_), "time runs backwards or is not finite",
                         fmt::format("{} s after {} s", time, last_time_), ""});
  last_time_ = time;
  ++rows_;
  time_buffer_.push_back(time);
  auto first = row.begin();
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const auto last = first + signals_[i].size();
    buffers_[i].insert(buffers_[i].end(), first, last);
    first = last;
  }
  if (time_buffer_.size() == chunk_rows_) commit();
}

void Recorder::commit() {
  if (time_buffer_.empty()) return;
  for (std::size_t i = 0; i < datasets_.size(); ++i) {
    datasets_[i].append(buffers_[i]);
    buffers_[i].clear();
  }
  time_.append(time_buffer_);
  time_buffer_.clear();
  file_.flush();
  const double rows = static_cast<double>(rows_);
  committed_rows_.assign({&rows, 1});
  file_.flush();
}

void Recorder::set_meta(const std::string& name, const hdf5::Value& value) {
  meta_.set_attribute(name, value);
}

void Recorder::set_run_meta(const std::string& name, const hdf5::Value& value) {
  run_meta_.set_attribute(name, value);
}

void Recorder::close(Outcome outcome, std::string_view why) {
  open_ = false;
  commit();
  set_meta("status", status_text(outcome, why));
  file_.close();
  std::error_code error;
  std::filesystem::rename(partial(path_), path_, error);
  if (error)
    throw NumericsError({path_, "cannot give the result file its final name: " + error.message(), "", ""});
}

}  // namespace wishbone
