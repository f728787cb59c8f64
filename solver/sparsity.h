#pragma once

#include <vector>

#include "solver/system.h"

namespace wishbone {

/// Which columns each row of a matrix may have entries in, ascending.
using SparsityPattern = std::vector<std::vector<int>>;

/// Pattern of dF/dy + c dF/dy' of the GGL form (solver/ggl_residual.h): bodies on one path to the root see each other, and so
/// do all bodies on the paths of the markers of one force element or one closure. The two rows of the energies, which
/// depend on everything and on which nothing depends, have their diagonal alone.
SparsityPattern ggl_pattern(const System& system, const std::vector<int>& kept);

/// Colours of columns such that no row has two entries of one colour: columns of a colour are differentiated together
/// [Curtis, Powell & Reid 1974], greedily in the given order.
std::vector<int> colour_columns(const SparsityPattern& pattern, int columns);

}  // namespace wishbone
