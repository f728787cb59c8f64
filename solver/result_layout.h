#pragma once

#include <map>
#include <string>

#include "core/hdf5.h"
#include "solver/signal.h"

namespace wishbone {

/// What all results files have in common, whole ones and those of runs under way: every dataset says units, frame and meaning, and
/// every dimension of a signal has a scale: `/time`, `/component_N` for the N numbers of a vector, `/vector_K` for K vectors. So
/// netCDF-4 tools find named dimensions, which they look for in the groups above a dataset.
class ResultLayout {
 public:
  /// `time` [nt] becomes the scale of the first dimension of all signals.
  ResultLayout(hdf5::File& file, hdf5::Dataset time);

  /// Gives a dataset [nt, shape...] its attributes and scales.
  void describe(hdf5::Dataset& dataset, const Signal& signal);
  /// Completes the scales. To be called when all signals are described.
  void finish();

  hdf5::Dataset& time() { return time_.dataset(); }

  /// True for the names at the root that are not for signals.
  static bool is_reserved(const std::string& path);

 private:
  hdf5::Scale* axis(const std::string& kind, int length);

  hdf5::File& file_;
  hdf5::Scale time_;
  std::map<std::string, hdf5::Scale> axes_;
};

/// /meta/rows: how many rows are good.
hdf5::Dataset create_row_count(hdf5::File& file, std::size_t rows);

}  // namespace wishbone
