#include "models/run_scene.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "core/version.h"
#include "core/yaml.h"
#include "identification/formats/identification_file.h"
#include "solver/recorder.h"
#include "solver/run_check.h"

namespace wishbone {
namespace {

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

/// "hinge: 0.001 m, 0 rad before, 2e-16 m, 0 rad after" for each closure.
std::vector<std::string> gap_lines(const AssemblyReport& assembly) {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < assembly.gaps.size(); ++c) {
    const ClosureGap &given = assembly.gaps[c], &closed = assembly.closed[c];
    lines.push_back(fmt::format("{}: {:.6g} m, {:.6g} rad before, {:.1g} m, {:.1g} rad after", given.name,
                                given.length, given.angle, closed.length, closed.angle));
  }
  return lines;
}

/// "pinion_bearing: speed: 0 before, -10 after" for each speed that follows from others.
std::vector<std::string> speed_lines(const System& system, const AssemblyReport& assembly) {
  std::vector<std::string> lines;
  for (const ChangedSpeed& speed : assembly.speeds)
    lines.push_back(fmt::format("{}: {:.6g} before, {:.6g} after", system.speed_name(speed.index),
                                speed.given, speed.assembled));
  return lines;
}

std::vector<std::string> passage_lines(const RunResult& result) {
  std::vector<std::string> lines;
  for (const NamedPassage& passage : result.singular_passages)
    lines.push_back(fmt::format("{:.9g} s: {}", passage.t, passage.row));
  return lines;
}

std::vector<std::string> change_lines(const std::vector<BetterMethod>& changes) {
  std::vector<std::string> lines;
  for (const BetterMethod& change : changes) lines.push_back(text(change));
  return lines;
}

std::vector<std::string> warning_lines(const Warnings& warnings) {
  std::vector<std::string> lines;
  for (const Diagnostic& warning : warnings) lines.push_back(warning.warning());
  return lines;
}

void record_facts(const Scene& scene, const System& system, const RunRequest& request,
                  const RunResult& result, Recorder& recorder) {
  recorder.set_meta("title", scene.title);
  recorder.set_meta("scene", scene.text);
  recorder.set_meta("overrides", request.overrides);
  recorder.set_meta("command_line", request.command_line);
  recorder.set_meta("version", std::string(kVersion));
  recorder.set_meta("git_revision", std::string(kGitRevision));
  recorder.set_meta("compiler", std::string(kCompiler));
  const TransientSummary& s = result.summary;
  recorder.set_meta("form", std::string(to_string(s.integrator.form)));
  recorder.set_meta("integrator", std::string(to_string(s.integrator.method)));
  recorder.set_meta("rtol", s.integrator.rtol);
  recorder.set_meta("atol", s.integrator.atol);
  recorder.set_meta("redundant_rows", result.redundant_rows);
  recorder.set_meta("restarts", static_cast<double>(s.restarts));
  recorder.set_meta("t_end", s.t_end);
  for (const auto& [name, value] : s.statistics) recorder.set_meta("solver_" + name, value);
  recorder.set_meta("method_changes", change_lines(s.method_changes));
  recorder.set_meta("assembly_gaps", gap_lines(s.assembly));
  recorder.set_meta("assembly_speeds", speed_lines(system, s.assembly));
  recorder.set_meta("singular_passages", passage_lines(result));
  recorder.set_meta("warnings", warning_lines(result.warnings));
  for (const auto& [name, count] : named_counts(result.work))
    recorder.set_meta("work_" + name, static_cast<double>(count));
  recorder.set_run_meta("host", host_name());
  recorder.set_run_meta("wall_seconds", result.wall_seconds);
  recorder.set_run_meta("cpu_seconds", result.cpu_seconds);
}

Outcome outcome(TransientSummary::Status status) {
  switch (status) {
    case TransientSummary::Status::complete:
      return Outcome::kComplete;
    case TransientSummary::Status::interrupted:
      return Outcome::kInterrupted;
    case TransientSummary::Status::failed:
      break;
  }
  return Outcome::kFailed;
}

/// Finds out on a copy of the initial state whether the run can start at all, so that no file is made in vain and no
/// earlier one replaced.
/// @throws InputError when form and integrator do not fit the system, a prescribed motion jumps or the state cannot be assembled
void check_start(const Scene& scene, const CompiledScene& compiled) {
  const IntegratorOptions options = resolved_options(scene, compiled);
  check_prescribed_motions(compiled.system, compiled.transient.duration, options);
  State state = compiled.initial;
  Workspace ws(compiled.system);
  assemble(compiled.system, state, ws, compiled.transient.given);
}

/// Every interval and both ends, and some for the two sides of jumps.
double expected_rows(const TransientOptions& options) {
  return std::ceil(options.duration / options.interval) + 64;
}

/// Places of what the scene calls `name` and keeps its results in `group`.
std::vector<std::string> places_named(const std::string& name, const std::string& group, const Scene& scene) {
  std::vector<std::string> places;
  const auto note = [&](const char* in, const auto& elements) {
    for (const auto& element : elements)
      if (group == in && element.name == name) places.push_back(element.where.text());
  };
  note("/joints", scene.joints);
  note("/joints", scene.closures);
  note("/forces", scene.springs);
  note("/forces", scene.drives);
  note("/loads", scene.loads);
  return places;
}

/// Results are kept under the names of the parts of the scene: /forces/coil/length.
/// @throws InputError naming the places of two parts that want the same
void check_paths(const Scene& scene, const std::vector<Signal>& signals) {
  std::set<std::string> taken;
  for (const Signal& signal : signals) {
    if (taken.insert(signal.path).second) continue;
    const std::size_t begin = signal.path.find('/', 1) + 1, end = signal.path.find('/', begin);
    const std::string name = signal.path.substr(begin, end - begin);
    const std::vector<std::string> places = places_named(name, signal.path.substr(0, begin - 1), scene);
    throw InputError({places.empty() ? scene.output.where.text() : places.back(),
                      places.size() < 2 ? fmt::format("results of '{}' are kept under this path twice", name)
                                        : fmt::format("'{}' is the name of {} too", name, places.front()),
                      signal.path, "rename one of them: results are kept by name"});
  }
}

}  // namespace

std::string identified_modes_path(const std::string& output_path, const std::string& body) {
  const std::filesystem::path path(output_path);
  return (path.parent_path() / (path.stem().string() + "." + body + "_modes.h5")).string();
}

IntegratorOptions resolved_options(const Scene& scene, const CompiledScene& compiled) {
  const auto resolved = [&] { return resolve(compiled.transient.integrator, compiled.system); };
  return scene.analysis.where.text().empty() ? resolved() : within(scene.analysis.where, resolved);
}

RunResult run_scene(const Scene& scene, const CompiledScene& compiled, const RunRequest& request) {
  const auto wall_start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  OutputLock output(request.output_path);
  check_start(scene, compiled);
  Observer observer(compiled.system, compiled.observer);
  check_paths(scene, observer.signals());
  const std::vector<std::string> unmatched =
      within(scene.output.where, [&] { return observer.keep(scene.output.record); });
  for (const IdentifiedBody& body : compiled.identified)
    write_identification(identified_modes_path(request.output_path, body.body), body.identification);
  RunResult result;
  Workspace ws(compiled.system);
  Recorder recorder(std::move(output), observer.signals(),
                    {.expected_rows = expected_rows(compiled.transient)});

  result.summary = run_transient(
      compiled.system, compiled.initial, compiled.transient, ws,
      [&](const State& state, const Work& work) {
        recorder.append(state.t, observer.sample(state, work, ws));
      },
      request.keep_going);

  for (const std::string& pattern : unmatched)
    result.summary.warnings.push_back({scene.output.where.text(),
                                       "no signal matches this pattern of 'record'", pattern,
                                       "see the paths in docs/results.md, or remove it"});
  result.work = ws.work;
  for (const int row : result.summary.assembly.redundant_rows)
    result.redundant_rows.push_back(compiled.system.row_name(row));
  for (const SingularPassage& passage : result.summary.singular_passages)
    result.singular_passages.push_back(
        {passage.t, passage.row < 0 ? "" : compiled.system.row_name(passage.row)});
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  result.cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  result.warnings = compiled.warnings;
  std::ranges::copy(result.summary.warnings, std::back_inserter(result.warnings));
  record_facts(scene, compiled.system, request, result, recorder);
  recorder.close(outcome(result.summary.status), result.summary.message);
  return result;
}

}  // namespace wishbone
