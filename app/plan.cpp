#include "models/plan.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/analysis_options.h"
#include "app/command.h"
#include "app/scene_warnings.h"
#include "models/scene_loader.h"

namespace wishbone {

namespace {

struct Options {
  std::string scene;
  std::vector<std::string> set;
  AnalysisOptions analysis;
  bool json = false;
};

void print_list(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  fmt::print("\n{}\n", title);
  for (const std::string& line : lines) fmt::print("  {}\n", line);
}

void print_lines(const Scene& scene, const Plan& plan) {
  if (!scene.title.empty()) fmt::print("{}\n\n", scene.title);
  fmt::print("bodies                {:5d}   of which flexible {}\n", plan.bodies, plan.flexible_bodies);
  fmt::print("joint coordinates     {:5d}   speeds {}\n", plan.coordinates, plan.speeds);
  fmt::print("elastic coordinates   {:5d}\n", plan.elastic_coordinates);
  fmt::print("prescribed joints     {:5d}\n", plan.prescribed);
  fmt::print("cut joints            {:5d}   rows {}, redundant {}\n", plan.closures, plan.closure_rows,
             plan.redundant_rows.size());
  fmt::print("mobility              {:5d}   speeds minus independent closure rows\n", plan.mobility);
  fmt::print("force elements        {:5d}\n", plan.force_elements);
  fmt::print("integration           {} by {}\n", plan.form, plan.integrator);
  print_list("redundant closure rows, left out", plan.redundant_rows);
  print_list("tree", plan.tree);
  print_list("identified", plan.identified);
  print_list("kept", plan.kept);
  print_list("left out", plan.left_out);
}

void print_json(const Plan& plan) {
  const nlohmann::ordered_json out{{"bodies", plan.bodies},
                                   {"flexible_bodies", plan.flexible_bodies},
                                   {"coordinates", plan.coordinates},
                                   {"speeds", plan.speeds},
                                   {"elastic_coordinates", plan.elastic_coordinates},
                                   {"prescribed", plan.prescribed},
                                   {"closures", plan.closures},
                                   {"closure_rows", plan.closure_rows},
                                   {"redundant_rows", plan.redundant_rows},
                                   {"mobility", plan.mobility},
                                   {"force_elements", plan.force_elements},
                                   {"form", plan.form},
                                   {"integrator", plan.integrator},
                                   {"tree", plan.tree},
                                   {"identified", plan.identified},
                                   {"kept", plan.kept},
                                   {"left_out", plan.left_out}};
  fmt::print("{}\n", out.dump(2));
}

ExitCode run(const Options& options) {
  const Scene scene = load_scene(options.scene, options.set);
  CompiledScene compiled = compile(scene);
  print_warnings(compiled);
  apply(options.analysis, compiled.transient);
  const Plan plan = make_plan(compiled);
  options.json ? print_json(plan) : print_lines(scene, plan);
  return kDone;
}

}  // namespace

void add_plan(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Tell what a scene is compiled to, and what is left out");
  add_scene_arguments(*command, options->scene, options->set);
  add_analysis_options(*command, options->analysis);
  command->add_flag("--json", options->json, "print JSON");
  command->footer("Example:\n  wishbone plan models/scenes/impulse_steer.yaml --set chassis=rigid");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
