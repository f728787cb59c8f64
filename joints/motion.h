#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace wishbone {

/// A prescribed coordinate at one time: position [rad or m] and its time derivatives.
struct MotionValue {
  double position = 0;
  double rate = 0;
  double acceleration = 0;
};

/// A change that fades in and out: change s((t - time)/duration), with the quintic
///     s(u) = 6 u^5 - 15 u^4 + 10 u^3,   0 <= u <= 1,
/// constant outside. Twice continuously differentiable.
struct MotionStep {
  double time = 0;      ///< [s]
  double duration = 0;  ///< [s], positive
  double change = 0;    ///< [rad or m]
};

/// Ackermann geometry of one steered wheel: a steering command delta at the middle of the axle becomes
///     tan(left) = l tan(delta)/(l - (w/2) tan(delta)),   tan(right) = l tan(delta)/(l + (w/2) tan(delta)),
/// so that both wheels turn about one point of the rear axle's line: cot(right) - cot(left) = w/l.
struct Ackermann {
  enum class Side { kLeft, kRight };
  double wheelbase = 0;  ///< l [m]
  double track = 0;      ///< w [m], between the steering axes
  Side side = Side::kLeft;
};

/// A coordinate prescribed as a function of time: a start value plus a sum of smooth steps, optionally taken
/// as a steering command and turned into the angle of one wheel. Derivatives are exact.
class Motion {
 public:
  /// @throws InputError naming `element` when a step has no duration, the Ackermann geometry is not positive,
  ///   or the command can reach the angle tan(delta) = 2 l/w, at which the inner wheel stands across
  Motion(std::string_view element, double start, std::vector<MotionStep> steps,
         std::optional<Ackermann> ackermann = std::nullopt);

  MotionValue at(double t) const;

  /// Edges of the steps [s], ascending, each once: the third derivative jumps there, so an integrator should
  /// stop.
  std::vector<double> stop_times() const;

 private:
  double start_;
  std::vector<MotionStep> steps_;
  std::optional<Ackermann> ackermann_;
};

}  // namespace wishbone
