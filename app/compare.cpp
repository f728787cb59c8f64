#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/check_output.h"
#include "app/command.h"
#include "app/comparison.h"
#include "app/meta_text.h"
#include "app/report_html.h"
#include "app/text_table.h"
#include "core/partial_file.h"

namespace wishbone {

namespace {

struct Options {
  std::string a, b;
  std::string title_a, title_b;
  std::optional<std::string> html;
  Choice choice;
  bool json = false;
};

void print_lines(const Comparison& comparison, const Options& options) {
  fmt::print("A: {} ({})\nB: {} ({})\n{}\n\n", options.title_a, options.a, options.title_b, options.b,
             comparison.common_time.text());
  TextTable table({"signal", "unit", "max |A|", "max |B|", "max |A-B|", "rms A-B", "at [s]"}, 2);
  for (const Difference& d : comparison.differences)
    table.add_row({d.channel.text(), d.units, brief(d.max_a), brief(d.max_b), brief(d.max_difference),
                   brief(d.rms_difference), brief(d.time_of_maximum)});
  fmt::print("{}", table.text());
  for (const std::string& path : comparison.only_in_a) fmt::print("only in A: {}\n", path);
  for (const std::string& path : comparison.only_in_b) fmt::print("only in B: {}\n", path);
  for (const std::string& why : comparison.incomparable) fmt::print("not comparable: {}\n", why);
}

void print_json(const Comparison& comparison, const Options& options) {
  nlohmann::ordered_json out;
  out["a"] = {{"file", options.a}, {"title", options.title_a}};
  out["b"] = {{"file", options.b}, {"title", options.title_b}};
  const VectorX& time = comparison.common_time.time();
  out["time"] = {{"first", time[0]},
                 {"last", time[time.size() - 1]},
                 {"instants", time.size()},
                 {"interpolated", comparison.common_time.interpolated()}};
  out["differences"] = nlohmann::ordered_json::array();
  for (const Difference& d : comparison.differences)
    out["differences"].push_back({{"signal", d.channel.path},
                                  {"component", d.channel.name},
                                  {"units", d.units},
                                  {"max_a", json_number(d.max_a)},
                                  {"max_b", json_number(d.max_b)},
                                  {"max_difference", json_number(d.max_difference)},
                                  {"rms_difference", json_number(d.rms_difference)},
                                  {"time_of_maximum", d.time_of_maximum}});
  out["only_in_a"] = comparison.only_in_a;
  out["only_in_b"] = comparison.only_in_b;
  out["incomparable"] = comparison.incomparable;
  fmt::print("{}\n", json_text(out));
}

ExitCode run(Options options) {
  if (options.html) check_output(*options.html, {options.a, options.b});
  const ResultFile a(options.a);
  const ResultFile b(options.b);
  if (options.title_a.empty()) options.title_a = std::filesystem::path(options.a).stem().string();
  if (options.title_b.empty()) options.title_b = std::filesystem::path(options.b).stem().string();

  const Comparison comparison = compare(a, b, options.choice);
  if (options.html)
    write_file(*options.html, report_html({a, options.title_a}, {b, options.title_b}, comparison));
  if (options.json)
    print_json(comparison, options);
  else
    print_lines(comparison, options);
  return kDone;
}

}  // namespace

void add_compare(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("compare", "Put two result files side by side: differences and plots");
  command->add_option("A", options->a, "result file")->required();
  command->add_option("B", options->b, "result file")->required();
  command->add_option("--html", options->html, "write a page with plots, complete in itself, to this file");
  command->add_option("--signals", options->choice.globs,
                      "signals to compare, by path: '/tires/*' (several allowed)");
  command->add_flag("--all", options->choice.all,
                    "compare every signal, not only what a vehicle report shows");
  command->add_option("--title-a", options->title_a, "what to call A; its file name by default");
  command->add_option("--title-b", options->title_b, "what to call B; its file name by default");
  command->add_flag("--json", options->json, "print JSON");
  command->footer(
      "Differences are taken at the instants of A within the common time span; where B was recorded at "
      "other\n"
      "instants it is interpolated linearly, and the output says so. Comparing never fails because of a\n"
      "difference: `wishbone check` is the gate.\n\n"
      "Example:\n  wishbone compare rigid.h5 flexible.h5 --title-a Rigid --title-b Flexible --html "
      "report.html");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
