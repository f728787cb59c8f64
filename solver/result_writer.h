#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/hdf5.h"
#include "solver/row_table.h"
#include "solver/signal.h"

namespace wishbone {

/// Facts of /meta and of /meta/run.
struct ResultFacts {
  std::map<std::string, hdf5::Value> meta, run;
};

/// Writes a whole results file from the rows of a run, signal by signal and chunk by chunk: what it looks like depends on the rows
/// alone, not on when they came, and the memory that it takes not on how many there are. The file has its name when it is whole.
/// @throws NumericsError when it cannot be written
void write_results(const std::string& path, const std::vector<Signal>& signals, const RowTable& rows,
                   const ResultFacts& facts, const hdf5::SeriesStorage& storage);

}  // namespace wishbone
