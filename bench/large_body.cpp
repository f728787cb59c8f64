// The car with a chassis of many nodes: bench/large_body/make-chassis makes its matrices.
//
//   large_body reduce FOLDER [N]     N normal modes (40) and attachment modes of the model in FOLDER, stored as FOLDER/chassis.h5
//   large_body run [FOLDER]          steering impulse with that chassis, or with all 54 modes of the car's own of 20 nodes: prints
//                                    a row of a Markdown table
//   large_body evaluate [FOLDER]     a thousand evaluations, for profilers

#include <fmt/core.h>

#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>

#include "identification/flexible_modes.h"
#include "identification/formats/modal_file.h"
#include "identification/mode_set_of.h"
#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/assembly.h"
#include "solver/forward_dynamics.h"

namespace wishbone::bench {
namespace {

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Peak of the resident set so far [MB].
double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  return 0;
}

void reduce(const std::string& folder, const std::string& normal_modes) {
  const Scene scene = load_scene(folder + "/chassis.yaml", {"modes=" + normal_modes});
  const Scene::Flexible& flexible = *scene.bodies.at(0).flexible;
  const double read = cpu_seconds();
  const FlexibleModes reduced =
      flexible_modes(*flexible.model, flexible.modes, flexible.attachment.ids, flexible.constraint.ids);
  const ModeSet& set = reduced.set;
  write_modal_data(folder + "/chassis.h5",
                   modal_data_of(set, "chassis of many nodes, normal and attachment modes"));
  fmt::print("| nodes | shapes | reading, CPU s | modes, CPU s | peak memory, MB |\n|---|---|---|---|---|\n");
  fmt::print("| {} | {} | {:.2g} | {:.2g} | {:.0f} |\n", set.node_count(), set.mode_count(), read,
             cpu_seconds() - read, peak_megabytes());
}

/// The car with the chassis that was reduced before, or its own.
CompiledScene car(const std::string& folder) {
  Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/impulse_steer.yaml", {"chassis=modal"});
  if (!folder.empty()) {
    const std::string path = folder + "/reduced.yaml";
    std::ofstream(path) << "wishbone: 1\nbodies:\n  chassis:\n    form: modal\n    position: [0, 0, 0.5]\n"
                           "    flexible: {modes: {measured: {file: chassis.h5}}, damping: 1 %}\n";
    scene.bodies.at(0).flexible = load_scene(path).bodies.at(0).flexible;
  } else {
    scene.bodies.at(0).flexible->common_damping = 0.01;
  }
  return compile(scene);
}

void run(const std::string& folder) {
  CompiledScene compiled = car(folder);
  compiled.transient.duration = 0.5;
  Workspace ws(compiled.system);
  const double setup = cpu_seconds();
  const TransientSummary summary = run_transient(compiled.system, compiled.initial, compiled.transient, ws,
                                                 [](const State&, const Work&) {});
  const double seconds = cpu_seconds() - setup;
  if (summary.status != TransientSummary::Status::complete) throw std::runtime_error(summary.message);
  const ModalBody& chassis = compiled.system.flexible.at(0).modal;
  const WorkCounters& work = ws.work;
  fmt::print("| {} | {} | {:.2f} | {:.2f} | {} | {} | {} | {} | {:.1f} | {:.0f} |\n",
             chassis.set().node_count(), chassis.mode_count(), setup, seconds, work.position, work.forces,
             work.solves, work.closure_factorizations, 1e6 * seconds / static_cast<double>(work.solves),
             peak_megabytes());
}

void evaluate(const std::string& folder) {
  CompiledScene compiled = car(folder);
  Workspace ws(compiled.system);
  assemble(compiled.system, compiled.initial, ws);
  for (int i = 0; i < 1000; ++i) calc_forward_dynamics(compiled.system, compiled.initial, ws);
}

}  // namespace
}  // namespace wishbone::bench

int main(int argc, char** argv) {
  const std::string task = argc > 1 ? argv[1] : "", folder = argc > 2 ? argv[2] : "";
  if (task == "reduce" && !folder.empty())
    wishbone::bench::reduce(folder, argc > 3 ? argv[3] : "40");
  else if (task == "run")
    wishbone::bench::run(folder);
  else if (task == "evaluate")
    wishbone::bench::evaluate(folder);
  else
    return fmt::print(stderr, "usage: large_body reduce FOLDER [N] | run [FOLDER] | evaluate [FOLDER]\n"), 2;
  return 0;
}
