#pragma once

#include <vector>

#include "solver/system_builder.h"
#include "solver/transient.h"

/// Small mechanisms with closed solutions, and the run of one of them.
namespace wishbone::testing {

inline Matrix3 diagonal(double x, double y, double z) { return Vector3(x, y, z).asDiagonal(); }

struct Trajectory {
  TransientSummary summary;
  std::vector<State> states;
  std::vector<Work> work;
  const State& last() const { return states.back(); }
};

inline Trajectory simulate(const System& system, const State& initial, double duration, double interval,
                           double tolerance, Method method = Method::automatic, Form form = Form::automatic) {
  Workspace ws(system);
  TransientOptions options;
  options.duration = duration;
  options.interval = interval;
  options.integrator.form = form;
  options.integrator.method = method;
  options.integrator.rtol = options.integrator.atol = tolerance;
  Trajectory trajectory;
  trajectory.summary = run_transient(system, initial, options, ws, [&](const State& s, const Work& w) {
    trajectory.states.push_back(s);
    trajectory.work.push_back(w);
  });
  return trajectory;
}

/// Total energy with what has crossed the boundary; constant in every run.
double energy_balance(const System& system, const State& state, const Work& work);

/// Momentum of the whole mechanism: linear [kg m/s] below angular about the inertial origin [kg m^2/s].
Vector6 momentum(const System& system, const State& state);

}  // namespace wishbone::testing
