// Error against run time of the car: both manoeuvres, rigid and flexible chassis, over tolerances and integration forms.
// Prints one Markdown table a case. Errors are the largest difference of any vehicle signal from a run at rtol 1e-11,
// relative to the largest value of that signal.

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "models/compile.h"
#include "models/scene_loader.h"

namespace {

using namespace wishbone;

struct Variant {
  Form form;
  Method method;
  double rtol;
};

struct Run {
  std::vector<VectorX> rows;  // vehicle signals at every output
  double cpu_seconds = 0;
  double evaluations = 0;
  TransientSummary summary;
};

/// Motion of the chassis and deflection of the tires' springs: what a vehicle engineer looks at.
VectorX vehicle_signals(const State& state, const Work& work, Observer& observer, Workspace& ws) {
  const auto row = observer.sample(state, work, ws);
  std::vector<double> kept;
  std::size_t at = 0;
  for (const Signal& signal : observer.signals()) {
    const auto n = static_cast<std::size_t>(signal.size());
    const bool wanted = signal.path.starts_with("/vehicle/") || signal.path.ends_with("/deflection") ||
                        (signal.path.starts_with("/tires/") && signal.path.ends_with("/force"));
    if (wanted) kept.insert(kept.end(), row.begin() + at, row.begin() + at + n);
    at += n;
  }
  return Eigen::Map<VectorX>(kept.data(), static_cast<Eigen::Index>(kept.size()));
}

Run run(const CompiledScene& compiled, const Variant& variant) {
  TransientOptions options = compiled.transient;
  options.integrator = {variant.form, variant.method, variant.rtol, 0.1 * variant.rtol};
  Run result;
  Workspace ws(compiled.system);
  std::vector<std::pair<State, Work>> states;
  const std::clock_t start = std::clock();
  result.summary = run_transient(compiled.system, compiled.initial, options, ws,
                                 [&](const State& s, const Work& w) { states.emplace_back(s, w); });
  result.cpu_seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  for (const auto& [name, value] : result.summary.statistics)
    if (name.ends_with("_evaluations") && !name.starts_with("jacobian")) result.evaluations += value;

  // the signals are taken from the states afterwards, so that the table times the integration alone
  Observer observer(compiled.system, compiled.observer);
  for (const auto& [state, work] : states) result.rows.push_back(vehicle_signals(state, work, observer, ws));
  return result;
}

double error(const Run& a, const Run& reference) {
  const std::size_t n = std::min(a.rows.size(), reference.rows.size());
  VectorX scale = VectorX::Zero(reference.rows[0].size()), worst = scale;
  for (std::size_t i = 0; i < n; ++i) {
    scale = scale.cwiseMax(reference.rows[i].cwiseAbs());
    worst = worst.cwiseMax((a.rows[i] - reference.rows[i]).cwiseAbs());
  }
  double largest = 0;
  for (Eigen::Index i = 0; i < scale.size(); ++i)
    if (scale[i] > 1e-6)
      largest = std::max(largest, worst[i] / scale[i]);  // what stays zero by symmetry has no digits
  return largest;
}

void print_case(const std::string& scene_name, const std::string& chassis) {
  const std::string path = std::string(WISHBONE_SCENES) + "/" + scene_name + ".yaml";
  const CompiledScene compiled = compile(load_scene(path, {"chassis=" + chassis}));
  const double duration = compiled.transient.duration;
  const Run reference = run(compiled, {Form::index1, Method::erk, 1e-11});
  fmt::print("\n{}, {} chassis\n\n", scene_name, chassis);
  fmt::print(
      "| form | integrator | rtol | error | evaluations | CPU s per simulated s "
      "|\n|---|---|---|---|---|---|\n");
  std::vector<Variant> variants;
  for (const double rtol : {1e-3, 1e-4, 1e-5, 5e-6, 1e-6, 1e-7, 1e-8})
    variants.push_back({Form::index1, Method::erk, rtol});
  for (const double rtol : {1e-4, 1e-6}) variants.push_back({Form::index1, Method::bdf, rtol});
  for (const double rtol : {1e-4, 1e-6}) variants.push_back({Form::ggl, Method::bdf, rtol});
  for (const Variant& v : variants) {
    const Run r = run(compiled, v);
    const bool complete = r.summary.status == TransientSummary::Status::complete;
    fmt::print("| {} | {} | {:.0e} | {} | {:.0f} | {:.4f} |\n", to_string(v.form), to_string(v.method),
               v.rtol, complete ? fmt::format("{:.1e}", error(r, reference)) : "failed", r.evaluations,
               r.cpu_seconds / duration);
  }
}

}  // namespace

int main() {
  for (const char* scene : {"sine_depression", "impulse_steer"})
    for (const char* chassis : {"rigid", "modal"}) print_case(scene, chassis);
  return 0;
}
