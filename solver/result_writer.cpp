#include "solver/result_writer.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/partial_file.h"
#include "solver/result_layout.h"

namespace wishbone {
namespace {

constexpr std::size_t kMostOpen = 512;                       // datasets
constexpr std::size_t kMostColumns = std::size_t{1} << 13;   // of several signals
constexpr std::size_t kBlockNumbers = std::size_t{1} << 21;  // 16 MiB

hdf5::Shape row_shape(const Signal& signal) {
  return {signal.shape.begin(), signal.shape.end()};
}

std::size_t width_of(const Signal& signal) {
  return static_cast<std::size_t>(signal.size());
}

/// As many of the signals as are written in one pass over the rows.
std::span<const Signal> one_pass(std::span<const Signal> signals) {
  std::size_t count = 0, columns = 0;
  while (count < std::min(signals.size(), kMostOpen)) {
    columns += width_of(signals[count]);
    if (count > 0 && columns > kMostColumns) break;
    ++count;
  }
  return signals.first(count);
}

/// Copies columns of the table into datasets, one beside the other from `first_column` on, by blocks of whole chunks.
class Pass {
 public:
  Pass(const RowTable& rows, std::size_t first_column) : rows_(rows), first_column_(first_column) {}

  void add(hdf5::Dataset dataset, std::size_t width, std::size_t chunk_rows) {
    outputs_.push_back({std::move(dataset), width});
    width_ += width;
    chunk_rows_ = std::max(chunk_rows_, chunk_rows);
  }

  void copy() {
    const std::size_t chunks = std::max<std::size_t>(1, kBlockNumbers / (chunk_rows_ * width_));
    const std::size_t most = chunks * chunk_rows_, all = rows_.committed_rows();
    for (std::size_t row = 0; row < all; row += most) copy_block(row, std::min(most, all - row));
  }

 private:
  struct Output {
    hdf5::Dataset dataset;
    std::size_t width;
  };

  void copy_block(std::size_t first_row, std::size_t count) {
    rows_.read(first_row, count, first_column_, width_, block_);
    std::size_t column = 0;
    for (Output& output : outputs_) {
      values_.clear();
      for (std::size_t row = 0; row < count; ++row) {
        const double* from = block_.data() + row * width_ + column;
        values_.insert(values_.end(), from, from + output.width);
      }
      output.dataset.append(values_);
      column += output.width;
    }
  }

  const RowTable& rows_;
  std::size_t first_column_, width_ = 0, chunk_rows_ = 1;
  std::vector<Output> outputs_;
  std::vector<double> block_, values_;
};

void write_signals(hdf5::File& file, std::span<const Signal> signals, const RowTable& rows,
                   const hdf5::SeriesStorage& storage) {
  ResultLayout layout(file, file.create_series("/time", {}, storage));
  Pass time(rows, 0);
  time.add(file.open_dataset("/time"), 1, storage.chunk_rows);
  time.copy();
  for (std::size_t column = 1; !signals.empty();) {
    const std::span<const Signal> chosen = one_pass(signals);
    Pass pass(rows, column);
    for (const Signal& signal : chosen) {
      hdf5::Dataset dataset = file.create_series(signal.path, row_shape(signal), storage);
      layout.describe(dataset, signal);
      pass.add(std::move(dataset), width_of(signal), hdf5::chunk_rows(row_shape(signal), storage.chunk_rows));
      column += width_of(signal);
    }
    pass.copy();
    signals = signals.subspan(chosen.size());
  }
  layout.finish();
}

}  // namespace

void write_results(const std::string& path, const std::vector<Signal>& signals, const RowTable& rows,
                   const ResultFacts& facts, const hdf5::SeriesStorage& storage) {
  PartialFile partial(path);
  hdf5::File file = hdf5::File::create(partial.name());
  {
    hdf5::Group meta = file.create_group("/meta"), run = file.create_group("/meta/run");
    create_row_count(file, rows.committed_rows());
    write_signals(file, signals, rows, storage);
    for (const auto& [name, value] : facts.meta) meta.set_attribute(name, value);
    for (const auto& [name, value] : facts.run) run.set_attribute(name, value);
  }
  file.close();
  partial.finish();
}

}  // namespace wishbone
