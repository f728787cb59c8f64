// A uniform rod hangs from a pin by its end and is let go from 60 degrees. After one second its angle must be that of the
// closed solution; the exit code tells.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "solver/system_builder.h"
#include "solver/transient.h"

using namespace wishbone;

namespace {

constexpr double kMass = 2.0;                    // [kg]
constexpr double kLength = 0.9;                  // [m]
constexpr double kStart = std::numbers::pi / 3;  // [rad]

// sin(theta/2) = k cd(omega t, k) with k = sin(kStart/2), omega^2 = 3 g/(2 L): 40-digit arithmetic gave
constexpr double kAngleAfterOneSecond = -0.855538618003473674;  // [rad]

std::pair<System, State> make_pendulum() {
  SystemBuilder builder;
  builder.gravity = Vector3(0, 0, -9.81);
  const double across = kMass * kLength * kLength / 12;  // a thin rod along z
  const Vector3 J(across, across, 1e-3 * across);
  const int rod =
      builder.add_body("rod", kMass, J.asDiagonal(), {Matrix3::Identity(), Vector3(0, 0, -kLength / 2)});
  builder.add_joint("pin", {}, rod, Vector3::Zero(), RevoluteJoint{Vector3::UnitY()}, kStart);
  return std::move(builder).build();
}

}  // namespace

int main() {
  const auto [system, initial] = make_pendulum();
  Workspace ws(system);
  TransientOptions options;
  options.integrator.rtol = options.integrator.atol = 1e-9;
  double angle = 0;
  const TransientSummary summary = run_transient(
      system, initial, options, ws, [&](const State& state, const Work&) { angle = state.q[0]; });
  fmt::print("{} at {} s: angle {:.12f} rad, closed solution {:.12f} rad\n", summary.message, summary.t_end,
             angle, kAngleAfterOneSecond);
  return std::abs(angle - kAngleAfterOneSecond) < 1e-8 ? 0 : 1;
}
