// Error against CPU time of the rigid benchmark problems (models/scenes/benchmarks), over integration forms, integrators and
// tolerances. Prints one Markdown table a problem, and for Andrews' mechanism what given errors cost. Errors are the largest
// of a few coordinates at the end of the run, each relative to its reference value; references are not made by this program.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/andrews_reference.h"
#include "bench/least_time.h"
#include "bench/work_precision.h"
#include "models/compile.h"
#include "models/scene_loader.h"

namespace {

using namespace wishbone;
using bench::Precision;

/// A component of a signal at the end of the run.
struct Quantity {
  std::string path;
  std::size_t component = 0;
  double offset = 0;  ///< to be added before it is compared
  double reference = 0;
};

struct Problem {
  std::string title, scene;
  std::vector<std::string> overrides;
  double duration;  ///< [s]
  std::vector<Quantity> quantities;
};

struct Scheme {
  Form form;
  Method method;
};

/// Angles and points of the reference solutions that the tests cite.
std::vector<Problem> problems() {
  using std::numbers::pi;
  std::vector<Problem> problems{
      {"Simple pendulum, 10 s",
       "simple_pendulum",
       {},
       10,
       {{"/joints/pin/coordinates", 0, -pi / 2, -2.78680673569982948435e-01}}},
      {"Double pendulum, 5 s",
       "double_pendulum",
       {},
       5,
       {{"/bodies/lower/position", 0, 0, -1.550778469470442800},
        {"/bodies/lower/position", 1, 0, -1.075912734812652457}}},
      {"Torque-free top, 100 s",
       "torque_free_top",
       {},
       100,
       {{"/bodies/top/orientation", 0, 0, 7.15401938045053785e-02},
        {"/bodies/top/orientation", 1, 0, -3.13690704852154371e-01},
        {"/bodies/top/orientation", 2, 0, -4.67159246132691487e-01},
        {"/bodies/top/orientation", 3, 0, -8.23554722597416570e-01}}},
      {"N-four-bar, N = 2, 10 s",
       "n_four_bar",
       {"N=2"},
       10,
       {{"/bodies/crank_0/position", 0, 0, 3.28458311540815378652e-01 / 2},
        {"/bodies/crank_0/position", 1, 0, 9.44518538178600962161e-01 / 2}}},
      {"N-four-bar, N = 40, 10 s",
       "n_four_bar",
       {"N=40"},
       10,
       {{"/bodies/crank_0/position", 0, 0, 1.80512226686728390103e-01 / 2},
        {"/bodies/crank_0/position", 1, 0, 9.83572740582311574881e-01 / 2}}},
      {"Bricard, 9 s", "bricard", {}, 9, {{"/joints/P0/coordinates", 0, 0, 1.00147056004}}},
      {"Flyball governor, 10 s",
       "flyball_governor",
       {},
       10,
       {{"/joints/guide/coordinates", 0, 0.5, 6.19622917061365659e-01}}}};
  Problem andrews{
      "Andrews' squeezing mechanism, 0.03 s", "andrews_squeezer", {}, bench::kAndrewsDuration, {}};
  for (const bench::AndrewsAngle& angle : bench::kAndrewsAngles)
    andrews.quantities.push_back(
        {std::string("/joints/") + angle.joint + "/coordinates", 0, angle.start, angle.end});
  problems.push_back(andrews);
  return problems;
}

CompiledScene load(const Problem& problem) {
  const std::string path = std::string(WISHBONE_SCENES) + "/benchmarks/" + problem.scene + ".yaml";
  return compile(load_scene(path, problem.overrides));
}

/// Forms and integrators that are worth a table: explicit ones do not suit the governor, whose fastest rate is 3e4 1/s, and
/// only explicit steps can be laid over singular positions.
std::vector<Scheme> schemes(const Problem& problem, const System& system) {
  if (problem.scene == "flyball_governor") return {{Form::ode, Method::bdf}};
  if (problem.scene == "n_four_bar") return {{Form::index1, Method::erk}};
  if (system.n_rows == 0)
    return {{Form::ode, Method::erk}, {Form::ode, Method::adams}, {Form::ode, Method::bdf}};
  std::vector<Scheme> schemes;
  for (const Form form : {Form::index1, Form::partition})
    for (const Method method : {Method::erk, Method::adams, Method::bdf}) schemes.push_back({form, method});
  schemes.push_back({Form::ggl, Method::bdf});
  return schemes;
}

double error(const Problem& problem, const Observer& observer, const double* row) {
  double worst = 0;
  for (const Quantity& quantity : problem.quantities) {
    std::size_t at = 0;
    for (const Signal& signal : observer.signals()) {
      if (signal.path == quantity.path) break;
      at += signal.size();
    }
    const double value = row[at + quantity.component] + quantity.offset;
    worst = std::max(worst, std::abs(value - quantity.reference) / std::abs(quantity.reference));
  }
  return worst;
}

struct Run {
  Precision precision;
  double steps = 0;
  WorkCounters work;
};

Run run(const Problem& problem, const CompiledScene& compiled, const Scheme& scheme, double tolerance) {
  TransientOptions options;
  options.duration = options.interval = problem.duration;
  options.integrator = {scheme.form, scheme.method, tolerance, 0.1 * tolerance, 0, 1'000'000};
  TransientSummary summary;
  State last;
  Work work;
  WorkCounters counters;
  Run result;
  result.precision.tolerance = tolerance;
  result.precision.cpu_seconds = bench::least_cpu_seconds([&] {
    Workspace ws(compiled.system);
    summary =
        run_transient(compiled.system, compiled.initial, options, ws, [&](const State& s, const Work& w) {
          last = s;
          work = w;
        });
    counters = ws.work;
    return summary.status == TransientSummary::Status::complete;
  });
  result.work = counters;
  for (const auto& [name, value] : summary.statistics)
    if (name == "steps") result.steps = value;
  result.precision.error = std::numeric_limits<double>::infinity();
  if (summary.status != TransientSummary::Status::complete) return result;
  Workspace ws(compiled.system);
  assemble(compiled.system, last, ws);  // the closures that a workspace solves for are found at a pose
  Observer observer(compiled.system, compiled.observer);
  result.precision.error = error(problem, observer, observer.sample(last, work, ws).data());
  return result;
}

std::vector<double> tolerances(const Problem& problem) {
  if (problem.scene == "n_four_bar") return {1e-4, 1e-6, 1e-8, 1e-9};
  if (problem.scene != "andrews_squeezer") return {1e-4, 1e-6, 1e-8, 1e-10};
  std::vector<double> half_decades;
  for (int k = 4; k <= 20; ++k) half_decades.push_back(std::pow(10.0, -0.5 * k));
  return half_decades;
}

void print_problem(const Problem& problem) {
  const CompiledScene compiled = load(problem);
  fmt::print("\n### {}\n\n", problem.title);
  fmt::print(
      "| form | integrator | rtol | error | steps | evaluations of forces | CPU ms "
      "|\n|---|---|---|---|---|---|---|\n");
  std::vector<std::pair<std::string, std::vector<Precision>>> lines;
  for (const Scheme& scheme : schemes(problem, compiled.system)) {
    const std::string form = to_string(scheme.form), method = to_string(scheme.method);
    lines.push_back({form + ", " + method, {}});
    for (const double tolerance : tolerances(problem)) {
      const Run r = run(problem, compiled, scheme, tolerance);
      lines.back().second.push_back(r.precision);
      fmt::print("| {} | {} | {:.1e} | {} | {:.0f} | {} | {:.3g} |\n", form, method, tolerance,
                 std::isfinite(r.precision.error) ? fmt::format("{:.1e}", r.precision.error) : "failed",
                 r.steps, r.work.forces, 1e3 * r.precision.cpu_seconds);
      std::fflush(stdout);
    }
  }
  if (problem.scene != "andrews_squeezer") return;
  fmt::print("\n");
  bench::print_cost_heading();
  for (const auto& [name, runs] : lines) bench::print_cost_row(name, runs);
}

}  // namespace

/// @param argv scenes to run; all without
int main(int argc, char** argv) {
  for (const Problem& problem : problems()) {
    const bool wanted = argc < 2 || std::any_of(argv + 1, argv + argc,
                                                [&](std::string_view name) { return name == problem.scene; });
    if (wanted) print_problem(problem);
  }
  return 0;
}
