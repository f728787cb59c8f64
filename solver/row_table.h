#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/descriptor.h"
#include "solver/signal.h"

namespace wishbone {

/// The rows of a run under way, PATH.partial: an HDF5 file in which every signal is a view (a virtual dataset) of columns of one
/// table, `/meta/table` [rows there is room for, 1 + numbers of all signals]; column 0 is the time.
///
/// No byte that HDF5 needs to open the file is written after the file has its name: rows are put into the room that the table has
/// (a hole in the file until then), then onto the disk, and only then counted in `/meta/rows`. So whatever ends the writer, a signal,
/// a full disk, or the loss of power, any HDF5 program opens the file, and the rows counted are whole; those beyond read as
/// anything. A table that is full is copied to one of twice the room, which takes its place when it is complete.
class RowTable {
 public:
  /// `room`: rows that are expected; `commit_seconds`: wall time after which rows are committed [s].
  /// @throws NumericsError, as all that writes, when the file cannot be written
  RowTable(std::string path, const std::vector<Signal>& signals, std::size_t room, double commit_seconds);

  /// Adds a row, the time in front. Rows wait in memory for a commit, for `commit_seconds` of wall time or a megabyte at most.
  void append(double time, std::span<const double> row);
  /// Puts all rows on the disk and counts them.
  void commit();

  std::size_t committed_rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  const std::string& name() const { return name_; }
  /// Columns [first_column, first_column + width) of `rows` committed rows from first_row on, row by row.
  void read(std::size_t first_row, std::size_t rows, std::size_t first_column, std::size_t width,
            std::vector<double>& values) const;
  /// Deletes the file.
  void remove();

 private:
  using Clock = std::chrono::steady_clock;

  void make_room(std::size_t rows);
  std::size_t place_of(std::size_t row, std::size_t column) const;

  std::string name_;
  const std::vector<Signal>& signals_;
  Clock::duration commit_interval_;
  std::size_t columns_ = 1;
  std::size_t room_ = 0, rows_ = 0;
  std::size_t table_offset_ = 0, count_offset_ = 0;  ///< in the file [bytes]
  Descriptor file_;
  std::vector<double> waiting_;
  Clock::time_point last_commit_{};
};

}  // namespace wishbone
