#pragma once

#include <vector>

#include "solver/workspace.h"

namespace wishbone {

/// The mechanism went through a position where closure rows depend on each other.
struct SingularPassage {
  double t = 0;  ///< [s], estimated between two steps
  int row = -1;  ///< the row that came closest to depending on the others
};

/// Finds singular positions that steps go over without touching: near one the least sine of the closure rows falls to zero
/// linearly in time and rises again with the same slope, where it would turn smoothly if it only came close. Rows of a
/// structure, which deforms but does not move, may stay close to dependent all the time: their sine wanders up and down in no
/// line, and small beside nothing that it was before.
class SingularWatch {
 public:
  /// After every accepted step.
  void observe(double t, const ClosureFactor& closure);
  /// Time [s] at which the sine would reach zero if it went on falling as between the last two steps; infinite while it rises.
  double expected() const;
  const std::vector<SingularPassage>& passages() const { return passages_; }

 private:
  struct Sample {
    double t = 0, sine = 1;
  };
  bool falls_along_a_line() const;

  Sample earlier_, before_, last_;
  double highest_ = 0;  // sine since the last passage
  std::vector<SingularPassage> passages_;
};

}  // namespace wishbone
