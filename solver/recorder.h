#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hdf5.h"

namespace wishbone {

/// One recorded quantity: where it goes in the result file and what a reader must know about it.
struct Signal {
  std::string path;        ///< "/bodies/chassis/position"
  std::vector<int> shape;  ///< of one row: {} scalar, {3} vector, {k, 3} k vectors
  std::string units;       ///< UDUNITS text, "m/s"; "1" for pure numbers
  std::string frame;       ///< axes of the components, "world"; empty for scalars without direction
  std::string about;       ///< one sentence for the reader
  /// Further attributes that are lists of texts, such as `nodes` of a deflection [k, 3].
  std::map<std::string, std::vector<std::string>> lists;

  /// Numbers in one row.
  int size() const;
};

struct RecorderOptions {
  int chunk_rows = 256;   ///< rows between two commits to the file: what a killed run loses at most
  int deflate_level = 4;  ///< 0 (none) to 9
};

/// How a run ended.
enum class Outcome { kComplete, kInterrupted, kFailed };

/// Streams the rows of a run to an HDF5 result file while the run goes on.
///
/// Layout: `/time` [nt] is a dimension scale attached to every signal; a signal of row shape S is a dataset
/// [nt, S...], chunked, shuffled and deflated, with the attributes `units`, `frame` and `about`. The group
/// `/meta` carries facts about the run as attributes, `status` among them: `running`, then `complete`,
/// `interrupted` or `failed: why`. What differs between two runs of one binary on one input (host, wall and
/// CPU time) goes to `/meta/run`; everything else is bitwise equal.
///
/// Crash safety: rows go to `OUT.h5.partial`, a commit every `chunk_rows` rows; close() renames to `OUT.h5`.
/// Each chunk is written once and whole, metadata reach the file by commits only, and a commit ends with the
/// number of rows it has made good, `/meta/rows`. A run that is killed leaves `OUT.h5.partial` with the
/// status `running`, readable by any HDF5 program up to `/meta/rows`; rows beyond it (death within a commit)
/// are to be ignored, as ResultFile does.
///
/// append() allocates nothing between commits.
class Recorder {
 public:
  /// Makes `path`.partial with all signals. Throws InputError when a signal path is not absolute, taken twice
  /// or reserved (/time, /meta), NumericsError when the file cannot be written.
  Recorder(std::string path, std::vector<Signal> signals, const RecorderOptions& options = {});
  /// Without close() the run counts as interrupted; a failure to write is then not reported.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Adds one row: the numbers of all signals in the order given to the constructor. Times must not decrease
  /// (two rows at one time mark the two sides of a jump). Throws InputError when the row has another length
  /// than the signals, NumericsError when time runs backwards or is not finite, or when the file cannot be
  /// written.
  void append(double time, std::span<const double> row);

  /// A fact about the run in /meta: equal for equal runs.
  void set_meta(const std::string& name, const hdf5::Value& value);
  /// A fact about this very execution in /meta/run: host, wall and CPU time.
  void set_run_meta(const std::string& name, const hdf5::Value& value);

  /// Writes what is left, sets the status, and gives the file its final name. `why` goes into the status of a
  /// failure.
  void close(Outcome outcome, std::string_view why = {});

  long rows() const { return rows_; }
  const std::vector<Signal>& signals() const { return signals_; }

 private:
  void commit();

  std::string path_;
  std::vector<Signal> signals_;
  std::size_t chunk_rows_;
  std::size_t row_length_ = 0;
  hdf5::File file_;
  hdf5::Group meta_;
  hdf5::Group run_meta_;
  hdf5::Dataset time_;
  hdf5::Dataset committed_rows_;
  std::vector<hdf5::Dataset> datasets_;

  std::vector<double> time_buffer_;
  std::vector<std::vector<double>> buffers_;  ///< per signal, rows of the chunk under way
  long rows_ = 0;
  double last_time_;
  bool open_ = true;
};

}  // namespace wishbone
