#pragma once

#include <optional>

#include "joints/motion.h"

namespace wishbone {

/// Where a motion, or its rate, has two values.
struct MotionJump {
  double time = 0;    ///< [s]
  double before = 0;  ///< position [rad or m], or rate [rad/s or m/s]
  double after = 0;

  double height() const { return after - before; }
};

struct MotionJumps {
  std::optional<MotionJump> position, rate;  ///< the first that were found
};

/// Looks for jumps of an expression from 0 to `duration`. Of a smooth motion
///     u(b) - u(a) = h/2 (u'(a) + u'(b)) - h^2/12 (u''(b) - u''(a)) + O(h^5),   h = b - a,
/// and likewise u' from u''; where this fails by more than the tolerance the interval is halved, towards the failure, until no
/// number lies between its ends: a steep motion has become flat by then, a jump is still there. Intervals are a fine grid of
/// the run, with the constants that the expression compares the time with. The search ends where the motion is undefined.
/// @param rtol, atol jumps below atol + rtol |u| are not seen by the run either
MotionJumps find_jumps(const Motion& motion, double duration, double rtol, double atol);

}  // namespace wishbone
