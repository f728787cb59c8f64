#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>

#include "app/check_output.h"
#include "app/command.h"
#include "app/option_value.h"
#include "core/error.h"
#include "core/glob.h"
#include "solver/recorder.h"
#include "solver/result_file.h"

namespace wishbone {

namespace {

struct Options {
  std::string input, output;
  std::vector<std::string> globs;
  double every = 0;  ///< [s]; zero: every row
};

constexpr double kSameInstant = 1e-12;  // [s]

/// Rows further apart than the run is long, or closer than instants can be told apart, are not what was meant.
void check_step(const ResultFile& file, double every) {
  const VectorX& time = file.time();
  const double duration = time.size() > 0 ? time[time.size() - 1] - time[0] : 0;
  if (every > duration + kSameInstant)
    throw InputError({"--every", fmt::format("the step is longer than the run of {} s", duration),
                      fmt::format("{} s", every), "ask for a shorter step"});
  if (every <= kSameInstant)
    throw InputError({"--every", fmt::format("instants less than {} s apart count as one", kSameInstant),
                      fmt::format("{} s", every), "ask for a longer step"});
}

/// Rows at the multiples of `every`, counted from the first row. Throws InputError when one of them was not
/// recorded.
std::vector<Eigen::Index> rows_every(const ResultFile& file, double every) {
  if (every > 0) check_step(file, every);
  const VectorX& time = file.time();
  std::vector<Eigen::Index> rows;
  long next = 0;  // the multiple that must come next, unless the last one comes a second time (a jump)
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const double elapsed = time[i] - time[0];
    const long multiple = every > 0 ? std::lround(elapsed / every) : i;
    if (every > 0 && std::abs(elapsed - static_cast<double>(multiple) * every) > kSameInstant) continue;
    if (multiple > next)
      throw InputError({file.path(), "there is no row at a multiple of the step asked for",
                        fmt::format("{} s", time[0] + static_cast<double>(next) * every),
                        "ask for a multiple of the step that was recorded"});
    rows.push_back(i);
    next = multiple + 1;
  }
  return rows;
}

std::vector<Signal> chosen_signals(const ResultFile& file, const std::vector<std::string>& globs) {
  std::vector<Signal> signals;
  for (const Signal& signal : file.signals())
    if (globs.empty() || matches_any(globs, signal.path)) signals.push_back(signal);
  if (signals.empty())
    throw InputError({file.path(), "no signal matches", fmt::format("{}", fmt::join(globs, " ")),
                      "`wishbone info` lists the signals; quote patterns, as in --signals '/tires/*'"});
  return signals;
}

/// The rows wanted of all signals, side by side.
MatrixX gather(const ResultFile& file, const std::vector<Signal>& signals,
               const std::vector<Eigen::Index>& rows) {
  int width = 0;
  for (const Signal& signal : signals) width += signal.size();
  MatrixX values(static_cast<Eigen::Index>(rows.size()), width);
  int column = 0;
  for (const Signal& signal : signals) {
    values.middleCols(column, signal.size()) = file.read(signal.path)(rows, Eigen::all);
    column += signal.size();
  }
  return values;
}

Outcome outcome_of(const std::string& status) {
  if (status == "complete") return Outcome::kComplete;
  return status.starts_with("failed") ? Outcome::kFailed : Outcome::kInterrupted;
}

void write_extract(const ResultFile& file, const Options& options) {
  const std::vector<Signal> signals = chosen_signals(file, options.globs);
  const std::vector<Eigen::Index> rows = rows_every(file, options.every);
  const MatrixX values = gather(file, signals, rows);

  Recorder recorder(options.output, signals);
  for (const auto& [name, value] : file.meta()) recorder.set_meta(name, value);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const VectorX row = values.row(static_cast<Eigen::Index>(i));
    recorder.append(file.time()[rows[i]], {row.data(), static_cast<std::size_t>(row.size())});
  }
  const std::string status = file.status();
  recorder.close(outcome_of(status), status.starts_with("failed: ") ? status.substr(8) : "");
  fmt::print("{}: {} of {} signals, {} of {} rows\n", options.output, signals.size(), file.signals().size(),
             rows.size(), file.time().size());
}

ExitCode run(const Options& options) {
  check_output(options.output, {options.input});
  const ResultFile file(options.input);
  write_extract(file, options);
  return kDone;
}

}  // namespace

void add_extract(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("extract", "Take some signals and instants out of a result file: a baseline");
  command->add_option("IN", options->input, "result file")->required();
  command->add_option("-o,--output", options->output, "file to write")->required();
  command->add_option("--signals", options->globs,
                      "signals to keep, by path: '/tires/*' (several allowed); default all");
  command
      ->add_option_function<std::string>(
          "--every",
          [options](const std::string& text) { options->every = positive_value("--every", text, kTime); },
          "keep rows this far apart: 10ms, 0.01; default every row")
      ->type_name("TIME");
  command->footer(
      "The extract is a result file like any other, with the facts about the run but not those about its "
      "execution:\n"
      "small enough to be kept beside the scene, for `wishbone check --against`.\n\n"
      "Example:\n  wishbone extract out.h5 -o base.h5 --signals '/vehicle/*' '/tires/*/deflection' --every "
      "10ms");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
