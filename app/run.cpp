#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/analysis_options.h"
#include "app/check_output.h"
#include "app/closure_text.h"
#include "app/command.h"
#include "app/meta_text.h"
#include "app/scene_inputs.h"
#include "app/warnings.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"

namespace wishbone {

namespace {

struct Options {
  std::string scene, output;
  std::vector<std::string> set;
  AnalysisOptions analysis;
  bool json = false;
};

volatile std::sig_atomic_t interrupted = 0;
extern "C" void on_interrupt(int) {
  interrupted = 1;
}

/// How far the run is, on standard error: on a terminal a line that overwrites itself, elsewhere (a log) a plain line, at
/// most one a second.
class Progress {
 public:
  Progress(double duration, bool wanted)
      : duration_(duration), wanted_(wanted), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~Progress() {
    if (percent_ >= 0) show("\r\033[K");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double t) {
    if (!wanted_) return;
    terminal_ ? overwrite(t) : log(t);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void overwrite(double t) {
    const int percent = static_cast<int>(100 * t / duration_);
    if (percent == percent_) return;
    percent_ = percent;
    show(fmt::format("\r{:3d} %  t = {:.3f} s", percent, t));
  }

  void log(double t) {
    const Clock::time_point now = Clock::now();
    if (now - last_line_ < std::chrono::seconds(1)) return;
    last_line_ = now;
    show(fmt::format("t = {:.3g} s of {:.6g} s\n", t, duration_));
  }

  /// A run that nobody can watch goes on: progress is no result.
  void show(const std::string& text) {
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) wanted_ = false;
  }

  double duration_;
  bool wanted_, terminal_;
  int percent_ = -1;                            ///< last shown on the terminal; -1: none
  Clock::time_point last_line_ = Clock::now();  ///< of the log; a run of less than a second leaves none
};

const char* status_text(TransientSummary::Status status) {
  switch (status) {
    case TransientSummary::Status::complete:
      return "complete";
    case TransientSummary::Status::interrupted:
      return "interrupted";
    case TransientSummary::Status::failed:
      break;
  }
  return "failed";
}

void print_lines(const Options& options, const RunResult& result) {
  const TransientSummary& s = result.summary;
  const std::size_t doubts = result.warnings.size();
  fmt::print("{}: {}{} at t = {:.6g} s, form {}, integrator {}\n", options.scene, status_text(s.status),
             doubts == 0 ? "" : fmt::format(" with {} warning{}", doubts, doubts == 1 ? "" : "s"), s.t_end,
             to_string(s.integrator.form), to_string(s.integrator.method));
  for (const auto& [name, value] : s.statistics) fmt::print("  {}: {}\n", name, value);
  if (s.restarts > 0) fmt::print("  restarts at events: {}\n", s.restarts);
  for (const BetterMethod& change : s.method_changes)
    fmt::print("  method changed at t = {}\n", wishbone::text(change));
  for (const std::string& row : result.redundant_rows)
    fmt::print("  redundant closure row left out: {}\n", row);
  for (const std::string& line : assembly_lines(s.assembly)) fmt::print("  {}\n", line);
  for (const std::string& line : passage_lines(result.singular_passages)) fmt::print("  {}\n", line);
  const std::string rate =
      s.t_end > 0 ? fmt::format(" ({:.4f} s per simulated second)", result.cpu_seconds / s.t_end) : "";
  fmt::print("  CPU {:.3f} s{}, results in {}\n", result.cpu_seconds, rate, options.output);
}

void print_json(const Options& options, const RunResult& result) {
  const TransientSummary& s = result.summary;
  nlohmann::ordered_json out{{"scene", options.scene},
                             {"output", options.output},
                             {"status", status_text(s.status)},
                             {"message", s.message},
                             {"t_end", s.t_end},
                             {"form", to_string(s.integrator.form)},
                             {"integrator", to_string(s.integrator.method)}};
  for (const auto& [name, value] : s.statistics) out["statistics"][name] = value;
  out["restarts"] = s.restarts;
  out["method_changes"] = nlohmann::ordered_json::array();
  for (const BetterMethod& change : s.method_changes)
    out["method_changes"].push_back({{"t", change.t},
                                     {"from", method_text(change.from)},
                                     {"to", method_text(change.to)},
                                     {"gain", change.gain}});
  out["redundant_rows"] = result.redundant_rows;
  for (std::size_t c = 0; c < s.assembly.gaps.size(); ++c)
    out["assembly"][s.assembly.gaps[c].name] = json_of(s.assembly.gaps[c], s.assembly.closed[c]);
  out["singular_passages"] = nlohmann::ordered_json::array();
  for (const NamedPassage& passage : result.singular_passages)
    out["singular_passages"].push_back({{"t", passage.t}, {"row", passage.row}});
  for (const auto& [name, count] : named_counts(result.work)) out["work"][name] = count;
  out["warnings"] = nlohmann::ordered_json::array();
  for (const Diagnostic& warning : result.warnings) out["warnings"].push_back(warning.warning());
  out["cpu_seconds"] = result.cpu_seconds;
  out["wall_seconds"] = result.wall_seconds;
  fmt::print("{}\n", json_text(out));
}

ExitCode run(const Options& options) {
  const Scene scene = load_scene(options.scene, options.set);
  const std::vector<std::string> inputs = input_files(options.scene, scene);
  check_output(options.output, inputs);
  for (const Scene::Body& body : scene.bodies)
    if (body.is_flexible() && body.flexible->identification)
      check_output(identified_modes_path(options.output, body.name), inputs);
  CompiledScene compiled = compile(scene);
  print_warnings(compiled.warnings);
  apply(options.analysis, compiled.transient);

  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) std::signal(SIGHUP, on_interrupt);  // unless by nohup
  RunResult result;
  {
    Progress progress(compiled.transient.duration, !options.json);
    const auto keep_going = [&](double t) {
      progress.update(t);
      return interrupted == 0;
    };
    result = run_scene(scene, compiled,
                       {options.scene, options.output, options.set, keep_going, options.analysis.as_written});
  }
  print_warnings(result.summary.warnings);
  options.json ? print_json(options, result) : print_lines(options, result);
  if (result.summary.status == TransientSummary::Status::complete) return kDone;
  const std::string message =
      fmt::format("{}\n  What was computed is kept in {}.\n", result.summary.message, options.output);
  std::fputs(message.c_str(), stderr);
  return kNumericsFailed;
}

}  // namespace

void add_run(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "Run a scene and write its results");
  add_scene_arguments(*command, options->scene, options->set);
  command->add_option("-o,--output", options->output, "results file (HDF5)")->required();
  add_analysis_options(*command, options->analysis);
  command->add_flag("--json", options->json, "print JSON");
  command->footer(
      "Example:\n  wishbone run models/scenes/impulse_steer.yaml -o rigid.h5 --set chassis=rigid");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
