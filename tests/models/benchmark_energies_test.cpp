// The energy books of the benchmark scenes, each run as its file says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"

namespace wishbone {
namespace {

const auto kBenchmarks = std::filesystem::path(WISHBONE_SCENES) / "benchmarks";

/// What the books of a run come to.
struct Books {
  double first = 0, drift = 0;  // of the sum that stays constant [J]
  double largest = 0;           // energy in motion and springs [J]
  bool started = false;

  void enter(const Energy& e, const Work& work) {
    const double sum =
        e.kinetic + e.gravity + e.elastic + work.loss - work.input;  // loss holds what springs store
    if (!started) first = sum;
    started = true;
    drift = std::max(drift, std::abs(sum - first));
    largest = std::max(largest, e.kinetic + e.elastic + e.springs);
  }
};

class BenchmarkScenes : public testing::TestWithParam<std::string> {};

TEST_P(BenchmarkScenes, CloseTheirEnergyBooksToTenTimesTheTolerance) {
  const CompiledScene compiled = compile(load_scene(kBenchmarks / (GetParam() + ".yaml")));
  Workspace run_ws(compiled.system), ws(compiled.system);
  Books books;
  const TransientSummary summary = run_transient(compiled.system, compiled.initial, compiled.transient,
                                                 run_ws, [&](const State& state, const Work& work) {
                                                   update_state(compiled.system, state, ws);
                                                   books.enter(calc_energy(compiled.system, state, ws), work);
                                                 });
  ASSERT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
  // of the energy in motion, and the weight along a metre
  const double tolerance =
      compiled.transient.integrator.rtol * (books.largest + 9.81 * compiled.system.total_mass());
  EXPECT_LE(books.drift, 10 * tolerance);
}

std::vector<std::string> names_of_benchmarks() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kBenchmarks))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}
INSTANTIATE_TEST_SUITE_P(, BenchmarkScenes, testing::ValuesIn(names_of_benchmarks()),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace wishbone
