#include "app/analysis_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "app/option_value.h"

namespace wishbone {

namespace {

constexpr double kCoarsestRtol = 0.1;  // as in a scene
constexpr double kMostOutputs = 1e7;   // as in a scene

Form read_form(const std::string& text) {
  return named_value<Form>("--form", text,
                           {{"auto", Form::automatic},
                            {"ode", Form::ode},
                            {"index1", Form::index1},
                            {"partition", Form::partition},
                            {"ggl", Form::ggl}},
                           "the integration forms");
}

Method read_integrator(const std::string& text) {
  return named_value<Method>(
      "--integrator", text,
      {{"auto", Method::automatic}, {"adams", Method::adams}, {"bdf", Method::bdf}, {"erk", Method::erk}},
      "the integrators");
}

double read_rtol(const std::string& text) {
  const double rtol = positive_value("--rtol", text, kRatio);
  if (rtol > kCoarsestRtol)
    throw InputError({"--rtol", "the relative tolerance is too coarse to mean anything", "'" + text + "'",
                      fmt::format("give at most {}; 1e-6 is usual", kCoarsestRtol)});
  return rtol;
}

}  // namespace

void add_analysis_options(CLI::App& command, AnalysisOptions& options) {
  const auto add = [&](const std::string& name, const std::string& type, const std::string& about,
                       const std::function<void(const std::string&)>& read) {
    command
        .add_option_function<std::string>(
            name,
            [&options, name, read](const std::string& text) {
              read(text);
              options.as_written.push_back(name + " " + text);
            },
            about)
        ->type_name(type)
        ->group("Instead of the scene's analysis");
  };
  add("--form", "NAME", "auto, ode, index1, partition or ggl",
      [&options](const std::string& text) { options.form = read_form(text); });
  add("--integrator", "NAME", "auto, adams, bdf or erk",
      [&options](const std::string& text) { options.integrator = read_integrator(text); });
  add("--rtol", "NUMBER", fmt::format("relative tolerance, at most {}", kCoarsestRtol),
      [&options](const std::string& text) { options.rtol = read_rtol(text); });
  add("--atol", "NUMBER", "absolute tolerance",
      [&options](const std::string& text) { options.atol = positive_value("--atol", text, kRatio); });
  add("--until", "TIME", "end of the run: 2, '2 s', 5ms",
      [&options](const std::string& text) { options.until = positive_value("--until", text, kTime); });
}

void apply(const AnalysisOptions& options, TransientOptions& transient) {
  transient.integrator.form = options.form.value_or(transient.integrator.form);
  transient.integrator.method = options.integrator.value_or(transient.integrator.method);
  transient.integrator.rtol = options.rtol.value_or(transient.integrator.rtol);
  transient.integrator.atol = options.atol.value_or(transient.integrator.atol);
  if (!options.until) return;
  transient.duration = *options.until;
  transient.interval = std::min(transient.interval, transient.duration);
  if (transient.duration / transient.interval > kMostOutputs)
    throw InputError({"--until", "the run would have more than ten million outputs",
                      fmt::format("{} s at an interval of {} s", transient.duration, transient.interval),
                      "end the run earlier, or give the scene a longer output.interval"});
}

void add_scene_arguments(CLI::App& command, std::string& scene, std::vector<std::string>& set) {
  command.add_option("SCENE", scene, "scene file (YAML)")->required();
  command.add_option("--set", set, "NAME=VALUE: another value for a parameter of the scene; may be repeated")
      ->type_name("NAME=VALUE")
      ->take_all();
}

}  // namespace wishbone
