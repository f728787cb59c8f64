#include "models/compile_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bodies/rigid_frames.h"
#include "core/yaml.h"
#include "identification/elements/mesh_estimate.h"
#include "identification/flexible_modes.h"
#include "identification/mode_set_of.h"
#include "identification/spin_stiffening.h"
#include "models/identification_sections.h"
#include "models/interface_nodes.h"

namespace wishbone {
namespace {

/// The ratios that the scene gives; those of the modes where it gives none.
void set_damping(const Scene::Body& body, ModeSet& modes) {
  if (const auto& rayleigh = body.flexible->rayleigh) {
    modes.damping_ratio = rayleigh->ratios(modes.omega);
    return;
  }
  if (const auto& ratio = body.flexible->common_damping) modes.damping_ratio.setConstant(*ratio);
  const std::vector<double>& ratios = body.flexible->damping;
  if (ratios.empty()) return;
  const auto count = static_cast<Eigen::Index>(ratios.size());
  if (count != modes.mode_count())
    throw InputError({body.where.text() + ".flexible.damping",
                      fmt::format("there are {} damping ratios for {} {}modes", count, modes.mode_count(),
                                  body.flexible->identification ? "identified " : ""),
                      "", "give one ratio for all modes, or one per mode"});
  modes.damping_ratio = Eigen::Map<const VectorX>(ratios.data(), count);
}

/// The nodes that static shapes are taken at; `interfaces`: those of the body.
const std::vector<int>& nodes_of(const Scene::StaticNodes& nodes, const std::vector<int>& interfaces) {
  return nodes.interfaces ? interfaces : nodes.ids;
}

/// The model that the modes are computed from; of a block it is made here.
std::shared_ptr<const AnalyticalModel> model_of(const Scene::Flexible& flexible) {
  if (flexible.model) return flexible.model;
  return std::make_shared<const AnalyticalModel>(
      identification_sections::mesh_model(identification_sections::block_body(*flexible.block)));
}

MatrixX stiffening_of(const Scene::Body& body, const AnalyticalModel& model, const ModeSet& modes) {
  const auto& asked = body.flexible->stiffening;
  if (!asked) return {};
  SpinLoad load{asked->held, std::nullopt};
  if (asked->centre_D) load.centre = body.X_DB.inverse() * *asked->centre_D;
  return spin_stiffening(model.elements->mesh, model.elements->material, modes, load);
}

std::string static_text(const Scene::StaticNodes& nodes, const std::vector<int>& interfaces,
                        const char* kind) {
  if (nodes.empty()) return "";
  const std::size_t count = nodes_of(nodes, interfaces).size();
  return fmt::format(" and {} modes of {} {}{}", kind, count, nodes.interfaces ? "interface" : "node",
                     count == 1 ? "" : "s");
}

std::string choice_text(const Scene::Flexible& flexible, const std::vector<int>& interfaces,
                        const FlexibleModes& modes) {
  std::string text = flexible.automatic ? "automatic: " : "";
  const bool held = flexible.modes_of == NormalModes::of_held_interfaces;
  text += describe(flexible.modes, held ? "fixed-interface" : "normal") +
          static_text(flexible.attachment, interfaces, "attachment") +
          static_text(flexible.constraint, interfaces, "constraint");
  if (modes.left_out > 0)
    text +=
        fmt::format("; {} static shape{} no more", modes.left_out, modes.left_out == 1 ? " adds" : "s add");
  return text;
}

Diagnostic split_warning(const std::string& body, double omega) {
  return {body,
          "the choice separates modes of equal frequency: which deflections it keeps is a matter of "
          "rounding, and a "
          "symmetric body is not symmetric any more",
          fmt::format("{:.4g} Hz", omega / (2 * std::numbers::pi)), "choose one more or one less"};
}

/// What the elements make of the lowest modes, the pair of a symmetric body among them. Higher modes are always coarser: the
/// limit to which they are wanted is the user's.
std::optional<Diagnostic> mesh_warning(const std::string& body, const MeshedBody& elements,
                                       const ModeSet& set) {
  constexpr Eigen::Index kJudged = 2;
  constexpr double kLimit = 0.3;  // of a frequency
  const Eigen::Index count = std::min<Eigen::Index>(kJudged, set.mode_count());
  const VectorX ratio = frequency_ratios(elements.mesh, elements.material, set.shapes.leftCols(count));
  Eigen::Index worst = 0;
  if (!(ratio.array().log().abs().maxCoeff(&worst) > std::log1p(kLimit))) return std::nullopt;
  const double found = set.omega[worst] / (2 * std::numbers::pi);
  return Diagnostic{body, "the mesh is too coarse for the lowest modes, or its elements do not bend",
                    fmt::format("mode {}: {:.4g} Hz, and about {:.3g} Hz by the elements' own estimate",
                                worst + 1, found, found / ratio[worst]),
                    elements.mesh.type == ElementType::mean_dilatation
                        ? "write 'element: incompatible_modes', or take more elements along every edge"
                        : "take more elements, along the waves of the mode first, or quadratic ones"};
}

/// With what rigid frames make of the modes.
BodyModes table_of(const Scene::Body& body, std::string choice, const FlexibleModes& modes,
                   const std::vector<int>& interfaces) {
  const std::vector<InterfaceFrame> rigid = rigid_frames(*body.flexible);
  if (rigid.empty()) return {body.name, std::move(choice), mode_table(modes.set, modes.kinds, interfaces)};
  const ModeSet left = as_modes(with_rigid_frames(shapes_of(modes.set), rigid));
  choice += fmt::format("; {} rigid frame{} {} of {}", rigid.size(),
                        rigid.size() == 1 ? " leaves" : "s leave", left.mode_count(), modes.set.mode_count());
  return {body.name, std::move(choice),
          mode_table(left, inherited_kinds(left, modes.set, modes.kinds), interfaces)};
}

}  // namespace

Warnings warnings_of(const std::vector<IdentifiedBody>& identified, const std::vector<BodyModes>& chosen) {
  Warnings warnings;
  for (const IdentifiedBody& body : identified)
    for (const std::string& warning : body.identification.judgement.warnings)
      warnings.push_back({body.body, warning, "", ""});
  for (const BodyModes& body : chosen)
    warnings.insert(warnings.end(), body.warnings.begin(), body.warnings.end());
  return warnings;
}

InterfaceFrame interface_frame(const Scene::Frame& frame) {
  return {frame.name, frame.nodes, frame.weights};
}

std::vector<InterfaceFrame> rigid_frames(const Scene::Flexible& flexible) {
  std::vector<InterfaceFrame> rigid;
  for (const Scene::Frame& frame : flexible.frames)
    if (frame.rigid) rigid.push_back(interface_frame(frame));
  return rigid;
}

StiffenedModes ModeCompiler::modes_of(int index) {
  const Scene::Body& body = scene_.bodies[static_cast<std::size_t>(index)];
  const Scene::Flexible& flexible = *body.flexible;
  const std::vector<int> interfaces = interface_nodes(scene_, index);
  FlexibleModes modes;
  MatrixX stiffening;
  std::string choice;
  std::optional<Diagnostic> doubt;
  within(body.where, [&] {
    if (flexible.identification) {
      identified.push_back({body.name, identify(*flexible.identification)});
      modes.set = mode_set_of(identified.back().identification.modes);
      modes.kinds.assign(static_cast<std::size_t>(modes.set.mode_count()), ModeKind::normal);
      choice = "all identified modes";
    } else {
      const auto model = model_of(flexible);
      modes = flexible_modes(*model, flexible.modes, nodes_of(flexible.attachment, interfaces),
                             nodes_of(flexible.constraint, interfaces), flexible.modes_of);
      stiffening = stiffening_of(body, *model, modes.set);
      if (model->elements) doubt = mesh_warning(body.name, *model->elements, modes.set);
      choice = choice_text(flexible, interfaces, modes);
    }
    return 0;
  });
  set_damping(body, modes.set);
  tables.push_back(within(body.where, [&] { return table_of(body, std::move(choice), modes, interfaces); }));
  if (doubt) tables.back().warnings.push_back(*doubt);
  for (const double omega : modes.split) tables.back().warnings.push_back(split_warning(body.name, omega));
  return {std::move(modes.set), std::move(stiffening)};
}

}  // namespace wishbone
