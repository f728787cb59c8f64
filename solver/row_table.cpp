#include "solver/row_table.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "core/hdf5.h"
#include "core/partial_file.h"
#include "solver/result_layout.h"

namespace wishbone {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{1} << 17;  // numbers: 1 MiB

static_assert(std::endian::native == std::endian::little, "tables hold little-endian numbers");

/// An empty table with its views; tells where in the file the table and the number of its rows are.
std::pair<std::size_t, std::size_t> write_empty_table(const std::string& path,
                                                      const std::vector<Signal>& signals, std::size_t room,
                                                      std::size_t columns) {
  hdf5::File file = hdf5::File::create(path);
  file.create_group("/meta").set_attribute("status", "running");
  const std::size_t count_offset = create_row_count(file, 0).file_offset();
  const hdf5::Dataset table = file.create_table("/meta/table", room, columns);
  const std::size_t table_offset = table.file_offset();
  {
    ResultLayout layout(file, file.create_view("/time", {}, table, 0));
    std::size_t column = 1;
    for (const Signal& signal : signals) {
      hdf5::Dataset view =
          file.create_view(signal.path, {signal.shape.begin(), signal.shape.end()}, table, column);
      layout.describe(view, signal);
      column += static_cast<std::size_t>(signal.size());
    }
    layout.finish();
  }
  file.close();
  return {table_offset, count_offset};
}

}  // namespace

RowTable::RowTable(std::string path, const std::vector<Signal>& signals, std::size_t room,
                   double commit_seconds)
    : name_(std::move(path) + ".partial"),
      signals_(signals),
      commit_interval_(
          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(commit_seconds))) {
  for (const Signal& signal : signals_) columns_ += static_cast<std::size_t>(signal.size());
  waiting_.reserve(std::max(kMostWaiting, columns_));
  make_room(room);
}

std::size_t RowTable::place_of(std::size_t row, std::size_t column) const {
  return table_offset_ + sizeof(double) * (row * columns_ + column);
}

void RowTable::make_room(std::size_t rows) {
  PartialFile fresh(name_);
  const auto [table_offset, count_offset] = write_empty_table(fresh.name(), signals_, rows, columns_);
  Descriptor file = Descriptor::open(fresh.name());
  std::vector<double> block;
  const std::size_t most = std::max<std::size_t>(1, kMostWaiting / columns_);
  for (std::size_t row = 0; row < rows_; row += most) {
    read(row, std::min(most, rows_ - row), 0, columns_, block);
    file.write(std::as_bytes(std::span(block)), table_offset + sizeof(double) * row * columns_);
  }
  const double count = static_cast<double>(rows_);
  file.write(std::as_bytes(std::span(&count, 1)), count_offset);
  fresh.finish();
  file_ = Descriptor::open(name_);
  table_offset_ = table_offset;
  count_offset_ = count_offset;
  room_ = rows;
}

void RowTable::append(double time, std::span<const double> row) {
  if (waiting_.size() + columns_ > waiting_.capacity()) commit();
  waiting_.push_back(time);
  waiting_.insert(waiting_.end(), row.begin(), row.end());
  if (Clock::now() - last_commit_ >= commit_interval_) commit();
}

void RowTable::commit() {
  if (waiting_.empty()) return;
  const std::size_t rows = rows_ + waiting_.size() / columns_;
  if (rows > room_) make_room(std::max(rows, 2 * room_));
  file_.write(std::as_bytes(std::span(waiting_)), place_of(rows_, 0));
  file_.sync();
  const double count = static_cast<double>(rows);
  file_.write(std::as_bytes(std::span(&count, 1)), count_offset_);
  rows_ = rows;
  waiting_.clear();
  last_commit_ = Clock::now();
}

void RowTable::read(std::size_t first_row, std::size_t rows, std::size_t first_column, std::size_t width,
                    std::vector<double>& values) const {
  values.resize(rows * width);
  const std::span<double> all(values);
  if (width == columns_) return file_.read(std::as_writable_bytes(all), place_of(first_row, 0));
  for (std::size_t row = 0; row < rows; ++row)
    file_.read(std::as_writable_bytes(all.subspan(row * width, width)),
               place_of(first_row + row, first_column));
}

void RowTable::remove() {
  file_.close();
  ::unlink(name_.c_str());
}

}  // namespace wishbone
