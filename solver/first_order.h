#pragma once

#include <exception>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "solver/energy.h"
#include "solver/progress_guard.h"
#include "solver/tangents.h"
#include "solver/workspace.h"

namespace wishbone {

/// Checks the accelerations (or residuals) of an evaluation, one for each speed.
/// @param x states of the force elements
/// @throws NumericsError naming the force element that is not finite, or the largest one and the speed that it drives away
void require_finite(const System& system, double t, const Eigen::Ref<const VectorX>& x,
                    const Eigen::Ref<const VectorX>& rates, const Evaluation<double>& ev);

/// The equations of motion as y' = f(t, y) with y = (q, v, x, work), x the states of the force elements and work the two
/// energies that have crossed the boundary: forms `ode` and `index1`. Also the guard between C++ exceptions and a C
/// integrator. Other choices of y derive from it.
class FirstOrderSystem {
 public:
  FirstOrderSystem(const System& system, Workspace& ws, ProgressGuard& guard);
  virtual ~FirstOrderSystem() = default;

  Eigen::Index size() const { return size_; }
  const System& system() const { return system_; }
  Workspace& workspace() { return ws_; }
  const Workspace& workspace() const { return ws_; }

  /// y of a consistent state, from which a new integration starts.
  virtual void pack(const State& state, const Work& work, Eigen::Ref<VectorX> y);
  virtual void unpack(double t, const Eigen::Ref<const VectorX>& y, State& state, Work& work);

  /// y' = (N v, v', x', work').
  virtual void calc_rate(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> y_rate);
  /// J = df/dy, exact (solver/tangents.h).
  virtual void calc_jacobian(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<MatrixX> J);
  /// Brings y onto the closures, positions to `tolerance`, as wishbone::project does; false when that fails.
  virtual bool project(double t, double tolerance, Eigen::Ref<VectorX> y, double implicit_step);
  void calc_events(double t, const Eigen::Ref<const VectorX>& y, double* g);
  /// After an accepted step: whether the choice of y no longer suits, so that the integration must start anew.
  virtual bool outlived();

  /// Factor on tolerances, 1/sqrt(size). SUNDIALS holds the root mean square of the weighted errors below one; with this
  /// factor every single coordinate meets its tolerance, and coordinates at rest do not loosen it for the others.
  double tolerance_scale() const;
  /// Absolute tolerances, scaled: `atol`, and for the energies what the weight of the whole mechanism does along it.
  void set_tolerances(double atol, Eigen::Ref<VectorX> tolerances) const;

  /// Of callbacks that evaluate without `unpack`: the time that their failures belong to.
  void note_time(double t) { state_.t = t; }
  /// The force element that exerts most at the last evaluation, for messages.
  std::string largest_force() const;
  /// What calc_jacobian and the factors of its result cost, in evaluations of the rate.
  double jacobian_cost() const;

  /// Name of an entry of y for messages.
  virtual std::string name(Eigen::Index i) const;

  /// Runs a callback's body, counted as `evaluations`: 0 when it went well, 1 (try a smaller step) after a NumericsError or when the
  /// body says false, -1 after any other exception, where the run is hopeless, and after NumericsErrors that come again and again at
  /// one time, which no step can pass. The exception is kept.
  template <class Body>
  int guard(Body&& body, double evaluations = 1) noexcept {
    try {
      progress_.count(evaluations);
      if constexpr (std::is_same_v<std::invoke_result_t<Body>, bool>) {
        if (!body()) return 1;
      } else {
        body();
      }
      if (state_.t > t_stuck_) failures_ = 0;  // of steps that have been taken otherwise since
      return 0;
    } catch (const HopelessRun&) {
      failure_ = std::current_exception();
      return -1;
    } catch (const NumericsError&) {
      failure_ = std::current_exception();
      return is_stuck() ? -1 : 1;
    } catch (...) {
      failure_ = std::current_exception();
      return -1;
    }
  }
  /// The exception of the last callback that failed, if any; forgets it.
  std::exception_ptr take_failure() { return std::exchange(failure_, nullptr); }

 protected:
  /// With y of another size than (q, v, x, work).
  FirstOrderSystem(const System& system, Workspace& ws, ProgressGuard& guard, Eigen::Index size);

  /// v', x' and work' at a state, left in the workspace; checked to be finite.
  Work calc_motion(const State& state);
  /// The scratch of derivatives, made when they are first asked for.
  Tangents& tangents();

  const System& system_;
  Workspace& ws_;
  ProgressGuard& progress_;
  Eigen::Index size_;
  State state_;  // scratch of the callbacks
  Work work_;

 private:
  /// Counts failures at the time of the last evaluation, up to a billionth of it.
  bool is_stuck();

  double weight_;  // of all bodies under standard gravity [N]
  bool needs_joint_forces_;
  std::unique_ptr<Tangents> tangents_;
  std::unique_ptr<Directions> directions_;  // one along every entry of (q, v, x)
  std::unique_ptr<MotionDerivatives> derivatives_;
  std::exception_ptr failure_;
  double t_stuck_ = -1;  // of the first of the failures that are counted
  int failures_ = 0;
};

}  // namespace wishbone
