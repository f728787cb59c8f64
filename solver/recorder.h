#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hdf5.h"
#include "core/output_lock.h"
#include "solver/result_writer.h"
#include "solver/row_table.h"
#include "solver/signal.h"

namespace wishbone {

struct RecorderOptions {
  int chunk_rows = 256;         ///< rows of one chunk of the finished file
  int deflate_level = 4;        ///< 0 (none) to 9
  double expected_rows = 0;     ///< room for which is made at once; more come at the cost of a copy
  double commit_seconds = 0.2;  ///< wall time between two commits [s]: what a killed run loses at most
};

/// How a run ended.
enum class Outcome { kComplete, kInterrupted, kFailed };

/// Keeps the rows of a run safe while it goes on, and makes a results file of them when it ends.
///
/// Layout: `/time` [nt] is a dimension scale attached to every signal; a signal of row shape S is a dataset
/// [nt, S...], chunked, shuffled and deflated, with the attributes `units`, `frame` and `about`; further dimensions have scales
/// too (ResultLayout). The group `/meta` carries facts about the run as attributes, `status` among them: `complete`,
/// `interrupted` or `failed: why`. What differs between two runs of one binary on one input (host, wall and
/// CPU time) goes to `/meta/run`; everything else is bitwise equal.
///
/// Safety: the output is locked. Rows go to the table `OUT.h5.partial`, which opens at every moment and has all but those of the
/// last `commit_seconds` (RowTable). close() writes `OUT.h5` beside it and removes it last: if there is no room, the rows are still
/// in the table, which ResultFile reads like any results file; its status is `running`.
///
/// append() allocates nothing between commits; the memory in use does not depend on the number of rows.
class Recorder {
 public:
  /// Makes the table of all signals at the path that is locked. Throws InputError when a signal path is not absolute, taken twice
  /// or reserved (/time, /meta, the axes), NumericsError when the file cannot be written.
  Recorder(OutputLock output, std::vector<Signal> signals, const RecorderOptions& options = {});
  /// Without close() the run counts as interrupted; a failure to write is then not reported.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Adds one row: the numbers of all signals in the order given to the constructor. Times must not decrease
  /// (two rows at one time mark the two sides of a jump). Throws InputError when the row has another length
  /// than the signals, NumericsError when time runs backwards or is not finite, or when the file cannot be
  /// written: says how many rows are safe, and where.
  void append(double time, std::span<const double> row);

  /// A fact about the run in /meta: equal for equal runs.
  void set_meta(const std::string& name, const hdf5::Value& value);
  /// A fact about this very execution in /meta/run: host, wall and CPU time.
  void set_run_meta(const std::string& name, const hdf5::Value& value);

  /// Writes the results file under its final name, in place of one that has it. `why` goes into the status of a
  /// failure.
  void close(Outcome outcome, std::string_view why = {});

  long rows() const { return rows_; }
  const std::vector<Signal>& signals() const { return signals_; }

 private:
  template <class Write>
  void write(Write&& write);

  OutputLock output_;
  std::vector<Signal> signals_;
  hdf5::SeriesStorage storage_;
  std::size_t row_length_ = 0;
  RowTable table_;
  ResultFacts facts_;
  long rows_ = 0;
  double last_time_;
  bool open_ = true;
};

}  // namespace wishbone
