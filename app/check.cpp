#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/check_output.h"
#include "app/command.h"
#include "app/junit.h"
#include "app/meta_text.h"
#include "app/regression.h"
#include "app/text_table.h"
#include "app/tolerances.h"
#include "core/did_you_mean.h"
#include "core/error.h"
#include "core/glob.h"
#include "core/partial_file.h"

namespace wishbone {

namespace {

struct Options {
  std::string fresh, base;
  std::string tolerances;
  std::vector<std::string> rules;
  std::optional<std::string> junit;
  bool json = false;
};

void print_lines(const std::vector<Verdict>& verdicts, const Options& options, long failures) {
  for (const Verdict& verdict : verdicts)
    if (!verdict.passed) fmt::print("FAILED {}: {}\n", verdict.signal, verdict.message);
  const auto worst =
      std::max_element(verdicts.begin(), verdicts.end(),
                       [](const Verdict& a, const Verdict& b) { return a.share() < b.share(); });
  if (worst->share() > 0)
    fmt::print("worst: {} at {:.6g} s, {} of its tolerance\n", worst->signal, worst->time,
               brief(worst->share()));
  fmt::print("{} against {}: {} of {} checks passed\n", options.fresh, options.base,
             static_cast<long>(verdicts.size()) - failures, verdicts.size());
}

void print_json(const std::vector<Verdict>& verdicts, const Options& options, long failures) {
  nlohmann::ordered_json out{{"new", options.fresh}, {"base", options.base}, {"passed", failures == 0}};
  out["checks"] = nlohmann::ordered_json::array();
  for (const Verdict& verdict : verdicts)
    out["checks"].push_back({{"signal", verdict.signal},
                             {"passed", verdict.passed},
                             {"message", verdict.message},
                             {"difference", verdict.difference},
                             {"allowed", verdict.allowed},
                             {"time", verdict.time}});
  fmt::print("{}\n", json_text(out));
}

/// A rule of the command line that touches no signal is a mistyped one, and the tolerance meant would be lost.
void add_rule(const std::string& rule, const ResultFile& base, Tolerances& tolerances) {
  const std::string glob = tolerances.add(rule);
  std::vector<std::string> paths;
  for (const Signal& signal : base.signals()) paths.push_back(signal.path);
  if (std::none_of(paths.begin(), paths.end(), [&](const std::string& p) { return matches(glob, p); }))
    throw InputError({"--tol", "no signal of " + base.path() + " matches", "'" + glob + "'",
                      did_you_mean(glob, paths, "its signals")});
}

ExitCode run(const Options& options) {
  if (options.junit) check_output(*options.junit, {options.fresh, options.base, options.tolerances});
  const ResultFile fresh(options.fresh);
  const ResultFile base(options.base);
  Tolerances tolerances;
  if (!options.tolerances.empty()) tolerances.load(options.tolerances);
  for (const std::string& rule : options.rules) add_rule(rule, base, tolerances);

  const std::vector<Verdict> verdicts = check(fresh, base, tolerances);
  const long failures =
      std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.passed; });
  if (options.junit)
    write_file(*options.junit, junit_xml(options.fresh + " against " + options.base, verdicts));
  if (options.json)
    print_json(verdicts, options, failures);
  else
    print_lines(verdicts, options, failures);
  return failures == 0 ? kDone : kComparisonFailed;
}

}  // namespace

void add_check(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("check", "Hold a run against a baseline: the regression gate for CI");
  command->add_option("NEW", options->fresh, "result file to check")->required();
  command->add_option("--against", options->base, "baseline, a result file or an extract of one")->required();
  command->add_option(
      "--tolerances", options->tolerances,
      "YAML file: a map from signals to tolerances, \"/tires/*\": {relative: 1e-5, absolute: 1e-7}");
  command
      ->add_option("--tol", options->rules,
                   "tolerance GLOB=RELATIVE[,ABSOLUTE]; after the file, the last wins")
      ->allow_extra_args(false);
  command->add_option("--junit", options->junit, "write JUnit XML to this file, one test case per signal");
  command->add_flag("--json", options->json, "print JSON");
  const Tolerance usual;
  command->footer(fmt::format(
      "A signal passes when |new - base| <= absolute + relative * max |base| at every instant of the base, "
      "the\n"
      "maximum over the whole signal. Unless told otherwise: relative {}, absolute {} (in the signal's "
      "unit).\n"
      "Missing signals, other shapes, units or frames, NaN, other time spans and incomplete runs fail. The "
      "base\n"
      "may hold fewer signals and fewer instants (`wishbone extract`); nothing is interpolated.\n"
      "Exit codes: 0 passed, 1 failed, 2 bad input.\n\n"
      "Example:\n  wishbone check new.h5 --against base.h5 --tol '/tires/*=1e-5,1e-7' --junit check.xml",
      usual.relative, usual.absolute));
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
