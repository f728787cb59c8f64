#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/analysis_options.h"
#include "app/body_modes_text.h"
#include "app/check_output.h"
#include "app/command.h"
#include "app/modal_summary.h"
#include "app/scene_inputs.h"
#include "app/warnings.h"
#include "core/did_you_mean.h"
#include "core/error.h"
#include "identification/mode_set_of.h"
#include "models/scene_loader.h"

namespace wishbone {

namespace {

struct Options {
  std::string scene, body, output;
  std::vector<std::string> set;
};

/// @throws InputError unless a flexible body has that name
int flexible_body(const Scene& scene, const Options& options) {
  std::vector<std::string> names;
  for (const Scene::Body& body : scene.bodies)
    if (body.is_flexible()) names.push_back(body.name);
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Scene::Body& body) {
    return body.is_flexible() && body.name == options.body;
  });
  if (found == scene.bodies.end())
    throw InputError({options.scene, "no flexible body of the scene has this name",
                      fmt::format("'{}'", options.body),
                      names.empty() ? "none is flexible: write 'form: modal'"
                                    : did_you_mean(options.body, names, "the flexible bodies")});
  return static_cast<int>(found - scene.bodies.begin());
}

ExitCode run(const Options& options) {
  const Scene scene = load_scene(options.scene, options.set);
  check_modal_output(options.output, input_files(options.scene, scene));
  const int body = flexible_body(scene, options);
  ModeCompiler compiler(scene);
  const StiffenedModes modes = compiler.modes_of(body);
  print_warnings(warnings_of(compiler.identified, compiler.tables));
  fmt::print("{}\n", text_of(compiler.tables.back()));
  write_and_tell(options.output, modal_data_of(modes.set, options.body + " of " + options.scene));
  return kDone;
}

}  // namespace

void add_modes(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("modes", "Find the modes of a flexible body once and store them");
  add_scene_arguments(*command, options->scene, options->set);
  command->add_option("BODY", options->body, "flexible body of the scene")->required();
  command
      ->add_option("-o,--output", options->output, "file of modes to write, as `wishbone convert` writes it")
      ->required();
  command->footer(
      "Normal and static modes as the scene chooses them. A scene that says 'modes: {measured: {file: "
      "OUT.h5}}' of the body\n"
      "reads them instead of finding them in every run.\n\n"
      "Example:\n  wishbone modes models/scenes/examples/flexible_arm.yaml upper -o upper.h5");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
