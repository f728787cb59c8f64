#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/hdf5_reader.h"
#include "solver/recorder.h"

namespace wishbone {

/// Reading side of the Recorder: the signals of a result file as matrices over time.
///
/// Reads finished files and what a killed run has left (`OUT.h5.partial`): all signals are cut to the rows
/// that every one of them has.
class ResultFile {
 public:
  /// Throws InputError when the file is missing, not HDF5, or without /time.
  explicit ResultFile(const std::string& path);

  const std::string& path() const { return path_; }
  /// All signals over time, sorted by path; /time itself is not among them.
  const std::vector<Signal>& signals() const { return signals_; }
  /// Signal of a path; nullptr when there is none.
  const Signal* find(const std::string& path) const;

  /// Times of the rows [s].
  const VectorX& time() const { return time_; }
  /// Signal as [nt x size], a row of shape {k, 3} laid out vector after vector. Throws InputError for unknown
  /// paths.
  MatrixX read(const std::string& path) const;

  /// Facts about the run (attributes of /meta).
  std::map<std::string, hdf5::Value> meta() const;
  /// Facts about the execution (attributes of /meta/run).
  std::map<std::string, hdf5::Value> run_meta() const;
  /// `complete`, `interrupted`, `failed: why`, `running` (killed or still going on); empty when the file does
  /// not say.
  std::string status() const;

 private:
  std::string path_;
  hdf5::FileReader file_;
  VectorX time_;
  std::vector<Signal> signals_;
};

/// Of `rows` rows those that the writer has made good: all, unless the run is under way or was killed.
/// @throws InputError when the file says something that is no number of rows
std::size_t good_rows(const hdf5::GroupReader& file, std::size_t rows);

/// A name for every number in a row: a scalar has the empty name; {3} gives x y z and {4} (quaternions) w x y
/// z when the signal has a frame, else the components have the names in the signal's list `rows` or are numbered from 1;
/// {k, n} gives the name of the vector (from the signal's list `nodes`, "node 19", else its number) and then its component.
std::vector<std::string> component_names(const Signal& signal);

}  // namespace wishbone
