// Cost of one evaluation of the equations of motion: nanoseconds of calc_forward_dynamics for serial chains of revolute joints
// and for the car. Prints a Markdown table; the smallest of several repetitions is taken.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/assembly.h"
#include "solver/forward_dynamics.h"
#include "solver/system_builder.h"

namespace {

using namespace wishbone;

double nanoseconds(const System& system, State state) {
  Workspace ws(system);
  assemble(system, state, ws);
  double best = 1e300;
  const int inner = std::max(10, 20000 / static_cast<int>(system.bodies.size()));
  for (int repetition = 0; repetition < 9; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < inner; ++i) calc_forward_dynamics(system, state, ws);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count() / inner);
  }
  return best;
}

/// N rods of unit length in a row along x, revolute joints about y and z in turn.
double chain(int n) {
  SystemBuilder b;
  b.gravity = {0, 0, -9.81};
  int previous = SystemBuilder::kGround;
  for (int i = 0; i < n; ++i) {
    const int rod = b.add_body("rod", 1.0, Vector3(0.01, 0.09, 0.09).asDiagonal(),
                               {Matrix3::Identity(), {i + 0.5, 0.0, 0.0}});
    b.add_joint("joint", {previous}, rod, {double(i), 0, 0},
                RevoluteJoint{i % 2 == 0 ? Vector3::UnitY() : Vector3::UnitZ()}, 0, 0.1 * std::sin(i));
    previous = rod;
  }
  const auto [system, state] = std::move(b).build();
  return nanoseconds(system, state);
}

double car(const char* chassis, const char* suspension) {
  const CompiledScene compiled =
      compile(load_scene(std::string(WISHBONE_SCENES) + "/impulse_steer.yaml",
                         {std::string("chassis=") + chassis, std::string("suspension=") + suspension}));
  return nanoseconds(compiled.system, compiled.initial);
}

}  // namespace

int main() {
  fmt::print("| system | ns per evaluation | ns per body |\n|---|---|---|\n");
  for (const int n : {10, 30, 100, 300, 1000, 10000}) {
    const double t = chain(n);
    fmt::print("| chain of {} | {:.0f} | {:.0f} |\n", n, t, t / n);
  }
  for (const char* suspension : {"floating", "hung"})
    for (const char* chassis : {"rigid", "modal"})
      fmt::print("| car, {} chassis, links {} | {:.0f} | |\n", chassis, suspension, car(chassis, suspension));
  return 0;
}
