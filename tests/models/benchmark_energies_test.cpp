// The energy books of the benchmark scenes, each run as its file says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"

namespace wishbone {
namespace {

/// The sum that stays constant, and what it is small against: all the energies it is made of.
struct Balance {
  double total = 0, size = 0;
};

Balance balance(const System& system, const State& state, const Work& work) {
  Workspace ws(system);
  update_state(system, state, ws);
  const Energy e = calc_energy(system, state, ws);
  // what springs store is part of work.loss
  Balance b;
  for (const double energy : {e.kinetic, e.gravity, e.elastic, work.loss, -work.input}) {
    b.total += energy;
    b.size += std::abs(energy);
  }
  return b;
}

TEST(BenchmarkScenes, CloseTheirEnergyBooksToTenTimesTheTolerance) {
  const auto folder = std::filesystem::path(WISHBONE_SCENES) / "benchmarks";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    CompiledScene compiled = compile(load_scene(entry.path()));
    Workspace ws(compiled.system);
    double first = 0, drift = 0, size = 0;
    bool started = false;
    const TransientSummary summary = run_transient(compiled.system, compiled.initial, compiled.transient, ws,
                                                   [&](const State& state, const Work& work) {
                                                     const Balance b = balance(compiled.system, state, work);
                                                     if (!started) first = b.total;
                                                     started = true;
                                                     drift = std::max(drift, std::abs(b.total - first));
                                                     size = std::max(size, b.size);
                                                   });
    EXPECT_EQ(summary.status, TransientSummary::Status::complete) << entry.path() << ": " << summary.message;
    EXPECT_LE(drift, 10 * compiled.transient.integrator.rtol * size) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace wishbone
