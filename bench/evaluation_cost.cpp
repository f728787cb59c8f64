// Cost of one evaluation of the equations of motion: nanoseconds of calc_forward_dynamics for the car (chain_cost.cpp has
// serial chains). Prints a Markdown table; the smallest of several repetitions is taken.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/assembly.h"
#include "solver/forward_dynamics.h"

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

double car(const char* chassis, const char* suspension) {
  const CompiledScene compiled =
      compile(load_scene(std::string(WISHBONE_SCENES) + "/impulse_steer.yaml",
                         {std::string("chassis=") + chassis, std::string("suspension=") + suspension}));
  return nanoseconds(compiled.system, compiled.initial);
}

}  // namespace

int main() {
  fmt::print("| system | ns per evaluation |\n|---|---|\n");
  for (const char* suspension : {"floating", "hung"})
    for (const char* chassis : {"rigid", "modal"})
      fmt::print("| car, {} chassis, links {} | {:.0f} |\n", chassis, suspension, car(chassis, suspension));
  return 0;
}
