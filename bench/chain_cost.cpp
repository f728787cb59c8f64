// Cost of one forward-dynamics evaluation of serial chains: microseconds for this library and, where their packages are
// installed (scripts/install-packages --bench), Debian's Simbody and MuJoCo. Prints a Markdown table. Engines take turns
// within one run and the smallest of many repetitions counts. Accelerations of the engines are compared first.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "bench/chain.h"
#include "solver/assembly.h"
#include "solver/forward_dynamics.h"
#include "solver/system_builder.h"

namespace wishbone::bench {
namespace {

std::pair<System, State> build(int rods) {
  SystemBuilder b;
  b.gravity = {0, 0, -ChainRod::kGravity};
  const Vector3 J(ChainRod::kAcross, ChainRod::kAcross, ChainRod::kAlong);
  int previous = SystemBuilder::kGround;
  for (int i = 0; i < rods; ++i) {
    const Vector3 top(0, 0, -i * ChainRod::kLength), middle(0, 0, -(i + 0.5) * ChainRod::kLength);
    const int rod = b.add_body("rod", ChainRod::kMass, J.asDiagonal(), {Matrix3::Identity(), middle});
    const Vector3 axis = ChainRod::turns_about_y(i) ? Vector3::UnitY() : Vector3::UnitX();
    b.add_joint("joint", {previous}, rod, top, RevoluteJoint{axis}, ChainRod::angle(i), ChainRod::speed(i));
    previous = rod;
  }
  return std::move(b).build();
}

class WishboneChain final : public Chain {
 public:
  explicit WishboneChain(int rods) : built_(build(rods)), ws_(built_.first) {
    assemble(built_.first, built_.second, ws_);
  }
  void evaluate() override { calc_forward_dynamics(built_.first, built_.second, ws_); }
  std::vector<double> accelerations() const override { return {ws_.v_rate.begin(), ws_.v_rate.end()}; }

 private:
  std::pair<System, State> built_;
  Workspace ws_;
};

struct Engine {
  std::unique_ptr<Chain> chain;
  double microseconds = std::numeric_limits<double>::infinity();
};

/// Largest difference relative to the largest acceleration.
double disagreement(Chain& a, Chain& b) {
  a.evaluate();
  b.evaluate();
  const std::vector<double> x = a.accelerations(), y = b.accelerations();
  double worst = 0, scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = std::max(worst, std::abs(x[i] - y[i]));
    scale = std::max(scale, std::abs(x[i]));
  }
  return worst / scale;
}

void measure(std::vector<Engine>& engines, int rods) {
  const int inner = std::max(1, 2000 / rods);
  for (int repetition = 0; repetition < 40; ++repetition)
    for (Engine& engine : engines) {
      if (!engine.chain) continue;
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < inner; ++i) engine.chain->evaluate();
      const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
      engine.microseconds = std::min(engine.microseconds, time.count() / inner);
    }
}

void print_row(int rods) {
  constexpr int kLongestSimbody = 3000;
  std::vector<Engine> engines(3);
  engines[0].chain = std::make_unique<WishboneChain>(rods);
  if constexpr (WISHBONE_BENCH_SIMBODY)
    if (rods <= kLongestSimbody) engines[1].chain = make_simbody_chain(rods);
  if constexpr (WISHBONE_BENCH_MUJOCO) engines[2].chain = make_mujoco_chain(rods);
  double difference = 0;
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (engines[k].chain)
      difference = std::max(difference, disagreement(*engines[0].chain, *engines[k].chain));
  measure(engines, rods);
  fmt::print("| {} | {:.2f} | {:.3f} |", rods, engines[0].microseconds, engines[0].microseconds / rods);
  for (std::size_t k = 1; k < engines.size(); ++k)
    fmt::print(" {} |", engines[k].chain ? fmt::format("{:.2f}", engines[k].microseconds) : "-");
  fmt::print(" {} |\n", engines[1].chain || engines[2].chain ? fmt::format("{:.0e}", difference) : "-");
  std::fflush(stdout);
}

}  // namespace
}  // namespace wishbone::bench

/// With a number of rods: evaluates that chain a thousand times and measures nothing, for profilers.
int main(int argc, char** argv) {
  if (argc > 1) {
    wishbone::bench::WishboneChain chain(std::stoi(argv[1]));
    for (int i = 0; i < 1000; ++i) chain.evaluate();
    return 0;
  }
  fmt::print("| rods | wishbone, us | us per rod | Simbody, us | MuJoCo, us | largest difference |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const int rods : {10, 30, 100, 300, 1000, 10000}) wishbone::bench::print_row(rods);
  return 0;
}
