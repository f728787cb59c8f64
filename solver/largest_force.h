#pragma once

#include <string>

#include "solver/evaluation.h"

namespace wishbone {

/// A force element by name and how much it exerts.
struct LargestForce {
  std::string name;  ///< empty: there are no force elements
  double magnitude =
      0;  ///< largest |f| [N] or |t| [N m] on a marker; infinite when something of it is not finite
};

/// The element that exerts most at the state of the last evaluation `ev`: where numbers run away, it is the first suspect. `x` are
/// the states of the force elements. Allocates: for messages.
/// @throws NumericsError of an element that is undefined there
LargestForce find_largest_force(const System& system, double t, const VectorX& x,
                                const Evaluation<double>& ev);

/// "; the largest force there is that of 'push', 3e+14 N or N m", and likewise the prescribed motion with the largest
/// acceleration; nothing when there are none. Of an element that is undefined there, what it says.
std::string largest_force_text(const System& system, double t, const VectorX& x,
                               const Evaluation<double>& ev);

}  // namespace wishbone
