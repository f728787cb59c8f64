#pragma once

#include <vector>

#include "solver/result_file.h"

namespace wishbone {

/// The components of a signal that are worth a plot each, ascending: all of a signal of few numbers; of many vectors (one a
/// node) those of the two that become longest in either file, of many scalars (one a mode or row) the four that become largest.
std::vector<int> notable_components(const Signal& signal, const ResultFile& a, const ResultFile& b);

/// Largest magnitude of each component over the rows of a file; empty when the file has no such signal.
VectorX peaks(const Signal& signal, const ResultFile& file);

}  // namespace wishbone
