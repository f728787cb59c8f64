#include "models/plan.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/analysis_options.h"
#include "app/body_modes_text.h"
#include "app/closure_text.h"
#include "app/command.h"
#include "app/meta_text.h"
#include "app/text_table.h"
#include "app/warnings.h"
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

void print_joints(const std::vector<JointChoice>& joints) {
  if (joints.empty()) return;
  TextTable table({"joint", "type", "bodies", "role", "rows", "why"}, 6);
  for (const JointChoice& j : joints)
    table.add_row({j.joint, j.kind, j.first + " - " + j.second, j.cut ? "cut" : "tree",
                   j.cut ? fmt::format("{}", j.rows) : "", j.reason});
  fmt::print("\n{}", table.text());
}

void print_closures(const Plan& plan) {
  if (plan.closures.empty()) return;
  TextTable table({"closure", "kind", "rows", "open as given", "after assembling"}, 5);
  for (const PlannedClosure& c : plan.closures)
    table.add_row({c.name, c.kind, fmt::format("{}", c.rows), text_of(c.given), text_of(c.closed)});
  fmt::print("\n{}", table.text());
  if (plan.displacement > 1e-9)
    fmt::print("assembling moves a coordinate by {:.4g} (m or rad) at most\n", plan.displacement);
}

void print_lines(const Scene& scene, const Plan& plan) {
  if (!scene.title.empty()) fmt::print("{}\n\n", scene.title);
  fmt::print("bodies                {:5d}   of which flexible {}\n", plan.bodies, plan.flexible_bodies);
  fmt::print("joint coordinates     {:5d}   speeds {}\n", plan.coordinates, plan.speeds);
  fmt::print("elastic coordinates   {:5d}\n", plan.elastic_coordinates);
  fmt::print("prescribed joints     {:5d}\n", plan.prescribed);
  fmt::print("closures              {:5d}   rows {}, rank {}, redundant {}\n", plan.closures.size(),
             plan.closure_rows, plan.rank, plan.redundant_rows.size());
  fmt::print("mobility              {:5d}   speeds minus rank\n", plan.mobility);
  fmt::print("force elements        {:5d}\n", plan.force_elements);
  fmt::print("integration           {} by {}{}\n", plan.form, plan.integrator,
             plan.changes_method ? ", and by another method where that takes less work" : "");
  print_joints(plan.joints);
  print_closures(plan);
  print_list("redundant closure rows, left out", plan.redundant_rows);
  print_list("speeds that follow from the closures and from those that are given [m/s, rad/s]",
             plan.speeds_changed);
  print_list("tree", plan.tree);
  for (const BodyModes& body : plan.modes) fmt::print("\n{}", text_of(body));
  print_list("identified", plan.identified);
  print_list("kept", plan.kept);
  print_list("left out", plan.left_out);
}

nlohmann::ordered_json json_of(const std::vector<JointChoice>& joints) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const JointChoice& j : joints)
    out.push_back({{"joint", j.joint},
                   {"type", j.kind},
                   {"bodies", {j.first, j.second}},
                   {"cut", j.cut},
                   {"pinned", j.pinned},
                   {"rows", j.rows},
                   {"loop", j.loop},
                   {"rows_saved", j.saved},
                   {"reason", j.reason}});
  return out;
}

nlohmann::ordered_json json_of(const std::vector<PlannedClosure>& closures) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const PlannedClosure& c : closures)
    out.push_back(
        {{"closure", c.name}, {"kind", c.kind}, {"rows", c.rows}, {"assembly", json_of(c.given, c.closed)}});
  return out;
}

nlohmann::ordered_json json_of(const std::vector<BodyModes>& bodies) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const BodyModes& body : bodies) {
    nlohmann::ordered_json modes = nlohmann::ordered_json::array();
    for (const ModeRow& mode : body.modes)
      modes.push_back({{"kind", to_string(mode.kind)},
                       {"frequency", mode.frequency},
                       {"damping_ratio", mode.damping_ratio},
                       {"effective_mass", mode.effective_mass},
                       {"node", mode.node}});
    out.push_back({{"body", body.body}, {"choice", body.choice}, {"modes", modes}});
  }
  return out;
}

void print_json(const Plan& plan) {
  const nlohmann::ordered_json out{{"bodies", plan.bodies},
                                   {"flexible_bodies", plan.flexible_bodies},
                                   {"coordinates", plan.coordinates},
                                   {"speeds", plan.speeds},
                                   {"elastic_coordinates", plan.elastic_coordinates},
                                   {"prescribed", plan.prescribed},
                                   {"joints", json_of(plan.joints)},
                                   {"closures", json_of(plan.closures)},
                                   {"closure_rows", plan.closure_rows},
                                   {"rank", plan.rank},
                                   {"redundant_rows", plan.redundant_rows},
                                   {"mobility", plan.mobility},
                                   {"displacement", plan.displacement},
                                   {"force_elements", plan.force_elements},
                                   {"form", plan.form},
                                   {"integrator", plan.integrator},
                                   {"changes_method", plan.changes_method},
                                   {"tree", plan.tree},
                                   {"modes", json_of(plan.modes)},
                                   {"identified", plan.identified},
                                   {"kept", plan.kept},
                                   {"left_out", plan.left_out}};
  fmt::print("{}\n", json_text(out));
}

ExitCode run(const Options& options) {
  const Scene scene = load_scene(options.scene, options.set);
  CompiledScene compiled = compile(scene);
  print_warnings(compiled.warnings);
  apply(options.analysis, compiled.transient);
  const Plan plan = make_plan(scene, compiled);
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
