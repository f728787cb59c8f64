#pragma once

#include "solver/random/mechanism.h"

namespace wishbone::testing {

/// What a random mechanism is to be like; everything else follows from the seed.
struct Likeness {
  int bodies = 10;
  int closures = 0;  ///< at most: those are left out that would leave too few freedoms or depend on others
  int springs = 4;   ///< with dampers
  bool floating = false;  ///< one free body carries all others, nothing holds on to the ground, no gravity
  bool common_closures =
      false;  ///< only those that other engines have too: no screws and no constant-velocity joints
};

/// Random masses, inertias, places and axes; tree joints and closures of all kinds.
Mechanism random_mechanism(const Likeness& likeness, Random& random);

/// The mechanism far from its design pose, with its closures closed, and moving.
Built in_random_state(Built mechanism, Random& random);
inline Built in_random_state(const Mechanism& mechanism, Random& random) {
  return in_random_state(build(mechanism), random);
}

/// How far the closures are from depending on each other: the smallest sine of a row's angle to those before it in the metric
/// of kinetic energy; 1 without closures, zero where rows are redundant.
double closure_sine(const Built& mechanism);

}  // namespace wishbone::testing
