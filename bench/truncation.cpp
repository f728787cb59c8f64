// What leaving out modes of the car's chassis changes: runs with few modes, with and without attachment modes where the
// suspension holds it, against all 54. Prints a Markdown table a case, in micrometres. rtol 1e-8.
//
//   truncation [PICTURE.svg]     also draws the runs of the undamped steering impulse

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/curve_picture.h"
#include "models/compile.h"
#include "models/interface_nodes.h"
#include "models/scene_loader.h"
#include "solver/kinematics.h"

namespace wishbone::bench {
namespace {

constexpr double kTolerance = 1e-8;
constexpr int kLookedAt = 20;   // node that the source looks at
constexpr double kShock = 0.3;  // in which what the start excites has died down where there is damping [s]

struct Variant {
  int normal;       ///< lowest modes that are kept
  bool attachment;  ///< attachment modes of the interfaces beside them
};

struct Run {
  std::string name;
  Eigen::Index modes = 0;
  VectorX time;
  MatrixX deflection;  ///< a row an output, x y z of each interface node, body axes [m]
  VectorX lateral;     ///< position of the chassis [m]
  Eigen::Index y, z;   ///< columns of the node that is looked at
};

std::string name_of(const Variant& variant, Eigen::Index modes) {
  if (!variant.attachment) return fmt::format("{} normal", variant.normal);
  return fmt::format("{} normal, {} attachment", variant.normal, modes - variant.normal);
}

Run run(const std::string& scene_name, const std::string& damping, const Variant& variant) {
  const Scene scene =
      load_scene(std::string(WISHBONE_SCENES) + "/" + scene_name + ".yaml",
                 {"chassis=modal", "damping=" + damping, fmt::format("modes={}", variant.normal),
                  std::string("correction=") + (variant.attachment ? "interfaces" : "none")});
  CompiledScene compiled = compile(scene);
  TransientOptions options = compiled.transient;
  options.integrator.rtol = kTolerance;
  options.integrator.atol = 0.1 * kTolerance;

  const FlexibleBody& chassis = compiled.system.flexible.at(0);
  const ShapeSet& set = chassis.modal.set();
  const std::vector<int> nodes = interface_nodes(scene, chassis.body);
  std::vector<int> rows;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * set.node_index(node) + axis);
  const MatrixX shapes = set.shapes(rows, Eigen::all);

  Run result;
  result.modes = shapes.cols();
  result.name = name_of(variant, result.modes);
  result.y = 3 * (std::find(nodes.begin(), nodes.end(), kLookedAt) - nodes.begin()) + 1;
  result.z = result.y + 1;
  const auto outputs = static_cast<Eigen::Index>(std::lround(options.duration / options.interval)) + 1;
  result.time = result.lateral = VectorX::Zero(outputs);
  result.deflection = MatrixX::Zero(outputs, shapes.rows());
  Workspace ws(compiled.system);
  Eigen::Index i = 0;
  const TransientSummary summary =
      run_transient(compiled.system, compiled.initial, options, ws, [&](const State& state, const Work&) {
        result.time[i] = state.t;
        result.deflection.row(i) = shapes * state.q.segment(chassis.z_start, shapes.cols());
        update_positions(compiled.system, state.t, state.q, ws);
        result.lateral[i] = ws.bodies[static_cast<std::size_t>(chassis.body)].X_WB.p.y();
        ++i;
      });
  if (summary.status != TransientSummary::Status::complete) throw std::runtime_error(summary.message);
  return result;
}

/// Length of the error of each interface node (columns) at each output (rows) [m].
MatrixX node_errors(const Run& a, const Run& reference) {
  const MatrixX difference = a.deflection - reference.deflection;
  MatrixX lengths(difference.rows(), difference.cols() / 3);
  for (Eigen::Index node = 0; node < lengths.cols(); ++node)
    lengths.col(node) = difference.middleCols<3>(3 * node).rowwise().norm();
  return lengths;
}

struct Errors {
  double y, late_y, z;  ///< of the node that is looked at, largest, and largest after kShock [m]
  double worst, mean;   ///< of the interface nodes: largest of any, root mean square over nodes and time [m]
  double lateral;       ///< of the chassis, largest [m]
};

Errors errors(const Run& a, const Run& reference) {
  const MatrixX nodes = node_errors(a, reference);
  const auto largest = [&](Eigen::Index column, Eigen::Index outputs) {
    return (a.deflection.col(column) - reference.deflection.col(column)).tail(outputs).cwiseAbs().maxCoeff();
  };
  const Eigen::Index all = a.time.size(), late = (a.time.array() > kShock).count();
  return {largest(reference.y, all),
          largest(reference.y, late),
          largest(reference.z, all),
          nodes.maxCoeff(),
          nodes.norm() / std::sqrt(static_cast<double>(nodes.size())),
          (a.lateral - reference.lateral).cwiseAbs().maxCoeff()};
}

std::string micrometres(double length) {
  return fmt::format("{:.3g}", 1e6 * length);
}

void print_row(const std::string& name, const Errors& e) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", name, micrometres(e.y), micrometres(e.late_y),
             micrometres(e.z), micrometres(e.worst), micrometres(e.mean), micrometres(e.lateral));
}

/// Runs of one manoeuvre, the complete one first.
std::vector<Run> print_case(const std::string& scene, const std::string& damping) {
  constexpr Variant kVariants[] = {{54, false}, {10, false}, {27, false},
                                   {44, false}, {10, true},  {27, true}};
  std::vector<Run> runs;
  for (const Variant& variant : kVariants) runs.push_back(run(scene, damping, variant));
  fmt::print("\n{}, structural damping {}\n\n", scene, damping);
  fmt::print(
      "| modes, of 54 | node {} in y | after {} s | in z | worst interface | rms of interfaces "
      "| chassis in y |\n|---|---|---|---|---|---|---|\n",
      kLookedAt, kShock);
  Run still = runs[0];
  still.deflection.setZero();
  still.lateral.setZero();
  print_row("size of the signal", errors(still, runs[0]));
  for (std::size_t i = 1; i < runs.size(); ++i) print_row(runs[i].name, errors(runs[i], runs[0]));
  std::fflush(stdout);
  return runs;
}

void draw(const std::string& path, const std::vector<Run>& runs) {
  constexpr double kShown = 0.6;  // [s] of the deflection
  Panel deflection{fmt::format("lateral deflection of node {} [mm]", kLookedAt), "time [s]", {}};
  Panel lateral{"lateral position of the chassis [m]", "time [s]", {}};
  for (const std::size_t i : {0, 1, 2, 4}) {
    const Run& r = runs[i];
    const Eigen::Index shown = (r.time.array() <= kShown).count();
    deflection.curves.push_back({r.name, r.time.head(shown), 1e3 * r.deflection.col(r.y).head(shown)});
    lateral.curves.push_back({r.name, r.time, r.lateral});
  }
  std::ofstream(path) << curve_picture("Modes of the chassis that are kept: steering impulse",
                                       {deflection, lateral});
}

}  // namespace
}  // namespace wishbone::bench

int main(int argc, char** argv) {
  using namespace wishbone::bench;
  for (const char* scene : {"sine_depression", "impulse_steer"})
    for (const char* damping : {"0", "5 %"}) {
      const std::vector<Run> runs = print_case(scene, damping);
      const bool drawn = std::string(scene) == "impulse_steer" && std::string(damping) == "0";
      if (argc > 1 && drawn) draw(argv[1], runs);
    }
  return 0;
}
