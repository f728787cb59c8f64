#pragma once

#include <string>
#include <vector>

#include "app/tolerances.h"
#include "solver/result_file.h"

namespace wishbone {

/// The judgement on one signal (or on `/meta/status` and `/time`, which are judged first).
struct Verdict {
  std::string signal;
  bool passed = true;
  std::string message;    ///< what was found, for people
  double difference = 0;  ///< max |new - base|
  double allowed = 0;     ///< absolute + relative * max |base|
  double time = 0;        ///< of the greatest difference [s]

  /// Difference as a share of what is allowed; above one the signal fails.
  double share() const;
};

/// Holds a run against its baseline.
///
/// Every signal of the base must be in the new file with equal shape, unit and frame, without NaN, and within
/// its tolerance at every instant of the base. The base may be a thinned-out copy: fewer signals, fewer
/// instants. Each of its instants must exist in the new file within 1e-12 s, nothing is interpolated, and the
/// new file may not go on for a whole step of the base after its last instant. The new run must be complete.
std::vector<Verdict> check(const ResultFile& fresh, const ResultFile& base, const Tolerances& tolerances);

}  // namespace wishbone
