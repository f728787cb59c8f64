#pragma once

#include <vector>

#include "solver/workspace.h"

namespace wishbone {

/// A row is redundant when what it has orthogonal to the rows before it is shorter than this part of its scale.
inline constexpr double kRankTolerance = 1e-7;

/// Rows of an independent subset, by orthogonalising the columns of U one after the other, that is the rows of D in the
/// metric of kinetic energy (so that metres and radians compare). Call with all rows kept. Earlier rows are preferred, so
/// that the same rows are named from scene to scene.
std::vector<int> find_independent_rows(const System& system, Workspace& ws);

/// What became of the choice of rows at an accepted state.
enum class RowRevision {
  unchanged,
  repivoted,  ///< another choice of as many rows is better conditioned: same motion, multipliers of other rows
  grown       ///< rows that were redundant no longer follow from the others: the rank has grown
};

/// Looks after the kept rows at an accepted state: chooses them anew when they are close to dependent and others are not,
/// or when rows that are left out open. Judges by the last evaluation, which was at this state or close to it.
RowRevision revise_rows(const System& system, const State& state, Workspace& ws);

/// Basis of the self-stresses of the closures: columns n (all rows) with D^T n = 0, one for each redundant row. Call after
/// calc_forward_dynamics.
MatrixX closure_self_stresses(const System& system, Workspace& ws);

}  // namespace wishbone
