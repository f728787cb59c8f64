#include "app/analysis_options.h"

#include <map>
#include <string>

namespace wishbone {

void add_analysis_options(CLI::App& command, AnalysisOptions& options) {
  static const std::map<std::string, Form> kForms{
      {"auto", Form::automatic}, {"ode", Form::ode}, {"index1", Form::index1}, {"ggl", Form::ggl}};
  static const std::map<std::string, Method> kMethods{
      {"auto", Method::automatic}, {"adams", Method::adams}, {"bdf", Method::bdf}, {"erk", Method::erk}};
  const char* group = "Instead of the scene's analysis";
  command.add_option("--form", options.form, "auto, ode, index1 or ggl")
      ->transform(CLI::CheckedTransformer(kForms).description(""))
      ->group(group);
  command.add_option("--integrator", options.integrator, "auto, adams, bdf or erk")
      ->transform(CLI::CheckedTransformer(kMethods).description(""))
      ->group(group);
  command.add_option("--rtol", options.rtol, "relative tolerance")->check(CLI::PositiveNumber)->group(group);
  command.add_option("--atol", options.atol, "absolute tolerance")->check(CLI::PositiveNumber)->group(group);
  command.add_option("--until", options.until, "end of the run [s]")
      ->check(CLI::PositiveNumber)
      ->group(group);
}

void apply(const AnalysisOptions& options, TransientOptions& transient) {
  transient.integrator.form = options.form.value_or(transient.integrator.form);
  transient.integrator.method = options.integrator.value_or(transient.integrator.method);
  transient.integrator.rtol = options.rtol.value_or(transient.integrator.rtol);
  transient.integrator.atol = options.atol.value_or(transient.integrator.atol);
  transient.duration = options.until.value_or(transient.duration);
}

}  // namespace wishbone
