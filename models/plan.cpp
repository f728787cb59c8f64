#include "models/plan.h"

#include <fmt/format.h>

#include "identification/formats/mode_file.h"
#include "models/run_scene.h"
#include "solver/assembly.h"
#include "solver/events.h"

namespace wishbone {
namespace {

std::string tree_line(const System& system, const TreeBody& body) {
  const std::string parent = body.parent < 0 ? "ground" : system.bodies[body.parent].name;
  std::string line = fmt::format("{}: {} on {}{}, {} freedom{}", body.name, joint_kind(body.joint), parent,
                                 body.on_frame                ? " (a frame)"
                                 : body.parent_interface >= 0 ? " (a node)"
                                                              : "",
                                 body.nv, body.nv == 1 ? "" : "s");
  if (body.flexible >= 0)
    line += fmt::format(", {} elastic modes", system.flexible[body.flexible].modal.mode_count());
  return line;
}

void sort_into(bool needed, std::string kept, std::string left_out, Plan& plan) {
  needed ? plan.kept.push_back(std::move(kept)) : plan.left_out.push_back(std::move(left_out));
}

/// Which of the two ways to its inertia a body takes, and what both would cost.
std::string inertia_line(const System& system, const FlexibleBody& body) {
  const ModalBody& modal = body.modal;
  const bool sums = modal.inertia_method() == InertiaMethod::node_sums;
  return fmt::format("inertia of {} by {}: {:g} multiplications an evaluation ({} {:g})",
                     system.bodies[body.body].name, sums ? "node sums" : "invariants",
                     modal.operations(modal.inertia_method()), sums ? "invariants" : "node sums",
                     modal.operations(sums ? InertiaMethod::invariants : InertiaMethod::node_sums));
}

void list_flexible_parts(const System& system, Plan& plan) {
  sort_into(plan.elastic_coordinates > 0, fmt::format("elastic terms of {} modes", plan.elastic_coordinates),
            "elastic terms: no flexible body", plan);
  if (plan.elastic_coordinates == 0) return;
  bool damped = false;
  std::string stiffened;
  for (const FlexibleBody& body : system.flexible) {
    const ShapeSet& set = body.modal.set();
    damped = damped || set.damped();
    if (set.stiffening.size() > 0)
      stiffened += (stiffened.empty() ? "" : ", ") + system.bodies[body.body].name;
    plan.kept.push_back(inertia_line(system, body));
  }
  sort_into(damped, "structural damping", "structural damping: every damping ratio is zero", plan);
  sort_into(!stiffened.empty(), "geometric stiffening of " + stiffened,
            "geometric stiffening: no body asks for it", plan);
}

void list_parts(const System& system, Plan& plan) {
  const auto& [springs, tires, loads, joint_springs, joint_frictions, joint_limits, joint_drives] =
      system.forces;
  list_flexible_parts(system, plan);
  sort_into(!plan.closures.empty(), fmt::format("closure solver for {} rows", plan.closure_rows),
            "closure solver and projection: no cut joint", plan);
  sort_into(plan.prescribed > 0, fmt::format("{} prescribed motions", plan.prescribed),
            "prescribed motions: none", plan);
  sort_into(!springs.empty(), fmt::format("{} spring-dampers", springs.size()), "springs: none", plan);
  sort_into(!tires.empty(), fmt::format("{} tires", tires.size()), "tires and road: no tire", plan);
  if (!tires.empty()) {
    sort_into(system.nx > 0, fmt::format("{} states of tire lag", system.nx), "tire lag: not asked for",
              plan);
    sort_into(event_count(system) > 0, "events at road edges", "events: the road has no edge", plan);
  }
  if (!joint_drives.empty()) plan.kept.push_back(fmt::format("{} drives of joints", joint_drives.size()));
  sort_into(!loads.empty(), fmt::format("{} loads", loads.size()), "loads: none", plan);
  sort_into(system.gravity.norm() > 0, "gravity", "gravity: zero", plan);
}

void list_closures(const System& system, const AssemblyReport& assembly, Plan& plan) {
  for (std::size_t c = 0; c < system.closures.size(); ++c) {
    const Closure& closure = system.closures[c];
    plan.closures.push_back(
        {closure.name, joint_kind(closure.joint), closure.rows, assembly.gaps[c], assembly.closed[c]});
  }
  for (const int row : assembly.redundant_rows) plan.redundant_rows.push_back(system.row_name(row));
  plan.rank = system.n_rows - static_cast<int>(assembly.redundant_rows.size());
  plan.displacement = assembly.displacement;
  for (const ChangedSpeed& speed : assembly.speeds)
    plan.speeds_changed.push_back(
        fmt::format("{}: {:.6g} -> {:.6g}", system.speed_name(speed.index), speed.given, speed.assembled));
}

std::string identified_line(const IdentifiedBody& body) {
  const ModalData& input = body.identification.input;
  const int count = body.identification.modes.mode_count();
  return fmt::format(
      "{}: {} mode{} identified from {} measured ones {}", body.body, count, count == 1 ? "" : "s",
      input.mode_count(),
      input.support.empty() ? "of the free structure" : "on " + describe_support(input.support));
}

}  // namespace

Plan make_plan(const Scene& scene, const CompiledScene& compiled) {
  const System& system = compiled.system;
  Plan plan;
  plan.bodies = static_cast<int>(system.bodies.size());
  plan.flexible_bodies = static_cast<int>(system.flexible.size());
  for (const FlexibleBody& body : system.flexible) plan.elastic_coordinates += body.modal.mode_count();
  plan.coordinates = system.nq - plan.elastic_coordinates;
  plan.speeds = system.nv - plan.elastic_coordinates;
  for (const TreeBody& body : system.bodies) {
    plan.prescribed += std::holds_alternative<PrescribedJoint>(body.joint) ? 1 : 0;
    plan.tree.push_back(tree_line(system, body));
  }
  plan.joints = joint_choices(scene);
  plan.closure_rows = system.n_rows;
  plan.force_elements = system.n_forces;

  Workspace ws(system);
  State state = compiled.initial;
  const AssemblyReport assembly = assemble(system, state, ws, compiled.transient.given);
  list_closures(system, assembly, plan);
  plan.mobility = system.nv - plan.rank;

  const IntegratorOptions integrator = resolved_options(scene, compiled);
  plan.form = to_string(integrator.form);
  plan.integrator = to_string(integrator.method);
  plan.changes_method =
      compiled.transient.integrator.method == Method::automatic && integrator.form != Form::ggl;
  plan.modes = compiled.modes;
  for (const IdentifiedBody& body : compiled.identified) plan.identified.push_back(identified_line(body));
  list_parts(system, plan);
  return plan;
}

}  // namespace wishbone
