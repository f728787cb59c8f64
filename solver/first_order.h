#pragma once

#include <exception>
#include <string>
#include <utility>

#include "core/error.h"
#include "solver/energy.h"
#include "solver/workspace.h"

namespace wishbone {

/// Checks the accelerations (or residuals) of an evaluation, one for each speed.
/// @throws NumericsError naming the first force element that is not finite, else the first speed that is not
void require_finite(const System& system, double t, const Eigen::Ref<const VectorX>& rates,
                    const Workspace& ws);

/// The equations of motion as y' = f(t, y) with y = (q, v, x, work), x the states of the force elements and work the two
/// energies that have crossed the boundary. Also the guard between C++ exceptions and a C integrator.
class FirstOrderSystem {
 public:
  FirstOrderSystem(const System& system, Workspace& ws);

  Eigen::Index size() const { return size_; }
  const System& system() const { return system_; }
  Workspace& workspace() { return ws_; }
  const Workspace& workspace() const { return ws_; }

  void pack(const State& state, const Work& work, Eigen::Ref<VectorX> y) const;
  void unpack(double t, const Eigen::Ref<const VectorX>& y, State& state, Work& work) const;

  /// y' = (N v, v', x', work').
  void calc_rate(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> y_rate);
  /// Brings y onto the closures, positions to `tolerance`; false when that fails.
  bool project(double t, double tolerance, Eigen::Ref<VectorX> y);
  void calc_events(double t, const Eigen::Ref<const VectorX>& y, double* g);

  /// Factor on tolerances, 1/sqrt(size). SUNDIALS holds the root mean square of the weighted errors below one; with this
  /// factor every single coordinate meets its tolerance, and coordinates at rest do not loosen it for the others.
  double tolerance_scale() const;
  /// Absolute tolerances, scaled: `atol`, and for the energies what the weight of the whole mechanism does along it.
  void set_tolerances(double atol, Eigen::Ref<VectorX> tolerances) const;

  /// Name of an entry of y for messages.
  std::string name(Eigen::Index i) const;

  /// Runs a callback's body: 0 when it went well, 1 (try a smaller step) after a NumericsError or a non-finite result, -1
  /// after any other exception. The exception is kept.
  template <class Body>
  int guard(Body&& body) noexcept {
    try {
      body();
      return 0;
    } catch (const NumericsError&) {
      failure_ = std::current_exception();
      return 1;
    } catch (...) {
      failure_ = std::current_exception();
      return -1;
    }
  }
  /// The exception of the last callback that failed, if any; forgets it.
  std::exception_ptr take_failure() { return std::exchange(failure_, nullptr); }

 private:
  const System& system_;
  Workspace& ws_;
  Eigen::Index size_;
  double weight_;  // of all bodies under standard gravity [N]
  State state_;    // scratch of the callbacks
  Work work_;
  VectorX q_rate_;
  std::exception_ptr failure_;
};

}  // namespace wishbone
