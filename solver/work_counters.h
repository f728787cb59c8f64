#pragma once

#include <string>
#include <utility>
#include <vector>

namespace wishbone {

/// Counts of work, the same on every machine. What a scene does not have is not evaluated, and its counter stays at zero.
struct WorkCounters {
  long position = 0, velocity = 0,
       forces = 0;               ///< sweeps of poses and of velocities, evaluations of all forces
  long signals = 0, drives = 0;  ///< signals and drives of joints within these evaluations
  long inertia = 0, solves = 0;  ///< factorisations of the tree, solutions for accelerations
  long inverse_dynamics = 0;     ///< residuals of the form ggl
  long tangents = 0;             ///< exact Jacobian matrices
  long closure_factorizations = 0, orthogonal_factorizations = 0;
  long projections = 0;     ///< corrections of positions or speeds
  long rank_searches = 0;   ///< for the independent closure rows
  long rank_revisions = 0;  ///< times that the rows solved for were exchanged
  long partitions = 0;      ///< choices of independent coordinates
};

/// The counters under the names by which results and reports know them.
std::vector<std::pair<std::string, long>> named_counts(const WorkCounters& work);

}  // namespace wishbone
