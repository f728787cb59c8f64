// Drift of the conserved quantities of a free, spinning, vibrating block: all inertial couplings of deformation and rotation
// (`inertia: consistent`) against the leading ones (`inertia: source`). Prints a Markdown table.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "identification/free_free_modes.h"
#include "solver/forward_dynamics.h"
#include "solver/system_builder.h"
#include "solver/transient.h"

namespace wishbone::bench {
namespace {

constexpr int kModes = 10;

/// The chassis of the car, undamped.
const ModeSet& block() {
  static const ModeSet modes =
      free_free_modes(make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation),
                      {2.1e8, 0.3, 2600})
          .lowest(kModes);
  return modes;
}

struct Conserved {
  double energy = 0;        ///< without that of the motion of the mass centre [J]
  Vector3 linear, angular;  ///< inertial axes, about the mass centre [N s, N m s]
};

/// Relative drift, largest so far.
struct Drift {
  double energy = 0, linear = 0, angular = 0;

  void note(const Conserved& start, const Conserved& now) {
    energy = std::max(energy, std::abs(now.energy / start.energy - 1));
    linear = std::max(linear, (now.linear - start.linear).norm() / start.linear.norm());
    angular = std::max(angular, (now.angular - start.angular).norm() / start.angular.norm());
  }
};

Conserved conserved(const System& system, const State& state, Workspace& ws) {
  update_state(system, state, ws);
  const FlexibleBody& body = system.flexible[0];
  const ModalBodyState& modal = ws.flexible[0].modal;
  const BodyMotion& motion = ws.bodies[0];
  const Vector3 v_B = motion.X_WB.R.transpose() * linear(motion.V);
  Conserved now;
  now.linear = motion.X_WB.R * body.modal.linear_momentum(v_B, modal);
  now.angular = motion.X_WB.R * body.modal.angular_momentum(v_B, modal);
  now.energy = body.modal.kinetic_energy(v_B, modal) + body.modal.elastic_energy(modal) -
               0.5 * now.linear.squaredNorm() / body.modal.mass();
  return now;
}

/// Every mode swings through zero so fast that it would, alone, deflect a node by `amplitude` [m].
void excite(const ModeSet& modes, double amplitude, double* z_rate) {
  for (int j = 0; j < modes.mode_count(); ++j) {
    const double largest = modes.shapes.col(j).reshaped(3, modes.node_count()).colwise().norm().maxCoeff();
    z_rate[j] = (j % 2 == 0 ? 1 : -1) * amplitude * modes.omega[j] / largest;
  }
}

void print_rows(InertiaTerms terms, double amplitude) {
  SystemBuilder builder;
  const int body = builder.add_flexible_body("block", block(), {}, terms);
  builder.set_velocity(body, {3, 1, -2}, {1.5, -0.8, 2.5});
  auto [system, initial] = std::move(builder).build();
  excite(block(), amplitude, initial.v.data() + system.flexible[0].z_rate_start);

  TransientOptions options;
  options.integrator = {Form::ode, Method::erk, 1e-12, 1e-13};
  options.duration = 10;
  options.interval = 0.01;
  Workspace ws(system), own(system);
  const Conserved start = conserved(system, initial, own);
  Drift drift;
  const TransientSummary summary =
      run_transient(system, initial, options, ws, [&](const State& state, const Work&) {
        drift.note(start, conserved(system, state, own));
        for (const double time : {0.1, 1.0, 10.0})
          if (std::abs(state.t - time) < 1e-6)
            fmt::print("| {} | {:g} | {:g} | {:.1e} | {:.1e} | {:.1e} |\n",
                       terms == InertiaTerms::source ? "source" : "consistent", 1e3 * amplitude, time,
                       drift.energy, drift.linear, drift.angular);
      });
  if (summary.status != TransientSummary::Status::complete) throw std::runtime_error(summary.message);
}

}  // namespace
}  // namespace wishbone::bench

int main() {
  using namespace wishbone;
  fmt::print(
      "| inertia | amplitude, mm | time, s | energy | linear momentum | angular momentum "
      "|\n|---|---|---|---|---|---|\n");
  for (const InertiaTerms terms : {InertiaTerms::source, InertiaTerms::consistent})
    for (const double amplitude : {1e-4, 1e-3, 1e-2, 3e-2}) bench::print_rows(terms, amplitude);
  return 0;
}
