#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/function.h"
#include "core/jet2.h"

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

/// A coordinate prescribed as a function of time: a start value plus a sum of smooth steps, a spline through
/// points, or an expression of the time; optionally taken as a steering command and turned into the angle of
/// one wheel. Derivatives are exact.
class Motion {
 public:
  /// @throws InputError naming `element` when a step has no duration, the Ackermann geometry is not positive,
  ///   or the command can reach the angle tan(delta) = 2 l/w, at which the inner wheel stands across
  Motion(std::string element, double start, std::vector<MotionStep> steps,
         std::optional<Ackermann> ackermann = std::nullopt);

  /// @param law function of the time alone. The points of a table must span the run: what is measured at its
  ///   ends is in general no rest, so they are not held
  /// @throws InputError naming `element` for a linear table, which has no acceleration where it bends; for a
  ///   function of more than the time; for an Ackermann geometry that is not positive
  Motion(std::string element, Function law, std::optional<Ackermann> ackermann = std::nullopt);

  /// @throws NumericsError naming the element and the time when the law has no value, rate or acceleration
  ///   there, the time is outside of its table, or the inner wheel would stand across
  MotionValue at(double t) const;

  /// Edges of the steps [s], ascending, each once: the third derivative jumps there, and a step between two
  /// evaluations would be missed, so an integrator should stop. At the points of a spline the third
  /// derivative jumps too, but little, and there may be many: they are left to the control of the error.
  /// Kinks of an expression are known where it calls step(t, ...) only.
  std::vector<double> stop_times() const;

  /// Whether it is an expression, which alone may jump or bend.
  bool may_jump() const { return law_ && law_->expression(); }
  /// Times at which it may jump [s], in no order: constants that an expression compares the time with.
  std::vector<double> switch_times() const;

 private:
  void check_ackermann() const;
  double steering_limit() const;
  Jet2 command(double t) const;
  [[noreturn]] void fail(const std::string& what, double t, double value, const std::string& remedy) const;

  std::string element_;
  double start_ = 0;
  std::vector<MotionStep> steps_;
  std::optional<Function> law_;  // instead of start and steps
  std::optional<Ackermann> ackermann_;
};

}  // namespace wishbone
