#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>

#include "bodies/interface_frame.h"
#include "identification/body_nodes.h"
#include "identification/elements/mesh.h"
#include "models/identification_loader.h"
#include "models/identification_sections.h"
#include "models/scene_doubts.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

void take_block(const Scene::Block& block, Scene::Flexible& flexible) {
  const Mesh mesh = identification_sections::block_body(block).mesh;
  flexible.block = block;
  flexible.node_ids = mesh.node_ids;
  flexible.node_position = mesh.nodes;
}

void take_model(const Value& value, Scene::Flexible& flexible, Scene& scene) {
  identification_sections::Files files;
  auto model = std::make_shared<const AnalyticalModel>(identification_sections::read_model(value, files));
  if (model->node_mass.size() == 0)
    value.refuse("a flexible body needs lumped masses, and this mass matrix is not lumped",
                 "add 'lumping: row_sum' or 'lumping: diagonal' to the model");
  flexible.node_ids = model->node_ids;
  const Vector3 centre = model->node_position * model->node_mass / model->node_mass.sum();
  flexible.node_position = model->node_position.colwise() - centre;
  flexible.model = std::move(model);
  scene.data_files.insert(scene.data_files.end(), files.read().begin(), files.read().end());
}

bool has_any(const Value& value, std::initializer_list<std::string_view> keys) {
  return value.is_mapping() &&
         std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return value.node()->find(key); });
}

double read_frequency(const Value& frequency) {
  return 2 * std::numbers::pi * frequency.positive(kFrequency);
}

ListedModes read_list(const Value& value, int elastic) {
  ListedModes listed;
  for (const Value& item : value.list()) listed.numbers.push_back(item.integer(1, elastic));
  std::sort(listed.numbers.begin(), listed.numbers.end());
  if (listed.numbers.empty())
    value.refuse("there are no modes in the list", "write 'modes: none' for a rigid body");
  if (std::adjacent_find(listed.numbers.begin(), listed.numbers.end()) != listed.numbers.end())
    value.refuse("a mode is listed twice", "list each mode once");
  return listed;
}

/// N, all, {lowest: N}, {below: F} or {list: [N, ...]}.
ModeChoice read_choice(const Value& value, int elastic) {
  if (value.is_word("all")) return AllModes{};
  if (looks_like_number(value.node()->text)) return LowestModes{value.integer(1, elastic)};
  const Mapping keys(value, {"lowest", "below", "list"});
  if (value.node()->entries.size() != 1)
    keys.refuse("one of 'lowest', 'below' and 'list' chooses the modes", "remove the others");
  if (const auto lowest = keys.optional("lowest")) return LowestModes{lowest->integer(1, elastic)};
  if (const auto below = keys.optional("below")) return ModesBelow{read_frequency(*below)};
  return read_list(keys.required("list"), elastic);
}

/// A node of the body.
int read_node(const Value& value, const std::vector<int>& node_ids) {
  const int node = value.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (std::find(node_ids.begin(), node_ids.end(), node) == node_ids.end())
    value.refuse("the body has no such node", identification_sections::nodes_text(node_ids));
  return node;
}

/// `interfaces`, or a list of nodes of the body.
Scene::StaticNodes read_static_nodes(const Value& value, const Scene::Flexible& flexible) {
  if (value.is_word("interfaces")) return {true, {}};
  if (!value.is_list())
    value.refuse("the nodes are neither 'interfaces' nor a list", "write 'interfaces', or [1, 2, 3]");
  Scene::StaticNodes nodes;
  for (const Value& item : value.list()) {
    const int id = read_node(item, flexible.node_ids);
    if (std::find(nodes.ids.begin(), nodes.ids.end(), id) != nodes.ids.end())
      item.refuse("a node is listed twice", "list each node once");
    nodes.ids.push_back(id);
  }
  if (nodes.ids.empty())
    value.refuse("there are no nodes in the list", "name at least one, or write 'interfaces'");
  return nodes;
}

/// All normal modes below a limit, and the attachment modes of every interface.
void take_automatic(const Mapping& keys, Scene::Flexible& flexible) {
  flexible.automatic = true;
  flexible.modes = ModesBelow{read_frequency(keys.required("below"))};
  flexible.attachment = {true, {}};
  if (const auto attachment = keys.optional("attachment"))
    attachment->refuse("'modes: automatic' takes the attachment modes of every interface already",
                       "remove the key");
}

/// {fixed_interface: ...}: normal modes with the interfaces held, and their constraint modes.
void take_fixed_interface(const Mapping& keys, const Value& modes, int elastic, Scene::Flexible& flexible) {
  const Mapping held(modes, {"fixed_interface"});
  flexible.modes_of = NormalModes::of_held_interfaces;
  flexible.modes = read_choice(held.required("fixed_interface"), elastic);
  if (!keys.has("constraint")) flexible.constraint = {true, {}};
}

/// Normal modes of a block or model, and static shapes beside them.
void take_model_modes(const Mapping& keys, const Value& modes, Scene::Flexible& flexible) {
  const int elastic = 3 * static_cast<int>(flexible.node_ids.size()) - 6;
  if (has_any(modes, {"fixed_interface"}))
    take_fixed_interface(keys, modes, elastic, flexible);
  else if (modes.is_word("automatic"))
    take_automatic(keys, flexible);
  else if (modes.is_word("none"))
    flexible.is_rigid = true;
  else if (modes.is_mapping() || modes.is_word("all") || looks_like_number(modes.node()->text))
    flexible.modes = read_choice(modes, elastic);
  else
    modes.refuse_choice({"all", "automatic", "none"}, "the choices of modes");

  if (const auto below = keys.optional("below"); below && !flexible.automatic)
    below->refuse("'below' belongs to 'modes: automatic'",
                  "write 'modes: {below: ...}' for normal modes alone");
  for (const auto& [key, nodes] :
       {std::pair("attachment", &flexible.attachment), {"constraint", &flexible.constraint}}) {
    const auto value = keys.optional(key);
    if (!value || !nodes->empty()) continue;
    *nodes = read_static_nodes(*value, flexible);
    if (flexible.is_rigid) value->refuse("a body without modes is rigid", "remove the key, or choose modes");
  }
}

/// How many modes there will be, where it is known before they are computed.
std::optional<int> known_count(const Scene::Flexible& flexible) {
  if (!flexible.attachment.empty() || !flexible.constraint.empty()) return std::nullopt;
  if (flexible.is_rigid) return 0;
  if (const auto* lowest = std::get_if<LowestModes>(&flexible.modes)) return lowest->count;
  if (const auto* listed = std::get_if<ListedModes>(&flexible.modes))
    return static_cast<int>(listed->numbers.size());
  if (std::holds_alternative<AllModes>(flexible.modes))
    return 3 * static_cast<int>(flexible.node_ids.size()) - 6;
  return std::nullopt;
}

/// {mass: alpha, stiffness: beta}.
RayleighDamping read_rayleigh(const Value& value) {
  const Mapping keys(value, {"mass", "stiffness"});
  RayleighDamping rayleigh;
  if (const auto mass = keys.optional("mass")) rayleigh.mass = mass->non_negative(kRate);
  if (const auto stiffness = keys.optional("stiffness")) rayleigh.stiffness = stiffness->non_negative(kTime);
  if (!keys.has("mass") && !keys.has("stiffness"))
    value.refuse("damping in proportion to mass and stiffness needs one of the two",
                 "write {mass: ... 1/s, stiffness: ... s}, or a damping ratio");
  return rayleigh;
}

/// One ratio for all modes, a list of one per mode, the length of which is checked where it is known already, or what gives
/// each mode its ratio.
void take_damping(const Value& value, std::optional<int> count, Scene::Flexible& flexible) {
  if (value.is_mapping()) {
    flexible.rayleigh = read_rayleigh(value);
    return;
  }
  if (!value.is_list()) {
    const double ratio = value.non_negative(kRatio);
    if (count)
      flexible.damping.assign(static_cast<std::size_t>(*count), ratio);
    else
      flexible.common_damping = ratio;
    return;
  }
  flexible.damping.clear();
  for (const Value& item : value.list()) flexible.damping.push_back(item.non_negative(kRatio));
  if (count && flexible.damping.size() != static_cast<std::size_t>(*count) && !flexible.is_rigid)
    value.refuse(fmt::format("there are {} damping ratios for {} modes", flexible.damping.size(), *count),
                 "give one ratio for all modes, or one per mode");
  if (flexible.damping.empty())
    value.refuse("there are no damping ratios in the list", "remove the key to keep those of the modes");
}

/// The modes are identified, and the nodes with them; a block or model is that of the identification unless it has its
/// own.
void take_identification(const Value& section, Scene::Flexible& flexible, Scene& scene) {
  std::optional<AnalyticalModel> model;
  if (flexible.block)
    model = identification_sections::mesh_model(identification_sections::block_body(*flexible.block));
  const AnalyticalModel* own_model = flexible.model ? flexible.model.get() : model ? &*model : nullptr;
  LoadedIdentification loaded = read_identification(section, own_model);
  if (loaded.task.goal == Goal::kHeld)
    section.refuse("a flexible body needs free-free modes", "write 'find: free', 'changed' or 'corrected'");
  const BodyNodes nodes = within(section.where(), [&] { return body_nodes(loaded.task); });
  flexible.node_ids = nodes.ids;
  flexible.node_position = nodes.position;
  scene.data_files.insert(scene.data_files.end(), loaded.files.begin(), loaded.files.end());
  flexible.identification = std::make_shared<const IdentificationTask>(std::move(loaded.task));
}

void refuse_static_shapes(const Mapping& keys) {
  for (const char* key : {"attachment", "constraint"})
    if (const auto value = keys.optional(key))
      value->refuse("static shapes need the stiffness of a model, and identified modes do not tell it",
                    "remove the key, or choose modes of a block or model");
  if (const auto below = keys.optional("below"))
    below->refuse("'below' belongs to 'modes: automatic'",
                  "choose among measured modes by 'modes: {measured: ...}'");
}

void take_nodes(const Mapping& keys, bool needed, Scene::Flexible& flexible, Scene& scene) {
  const auto model = keys.optional("model");
  if (model && (keys.has("block") || keys.has("material")))
    model->refuse("the nodes come either from a block or from a model", "remove one of the two");
  if (model)
    take_model(*model, flexible, scene);
  else if (needed || keys.has("block"))
    take_block(read_block(keys.required("block"), keys.required("material")), flexible);
}

/// {nodes: [...], weights: [...], rigid: true}.
Scene::Frame read_frame(const std::string& name, const Value& value, const Scene::Flexible& flexible) {
  Scene::Frame frame;
  frame.name = name;
  const auto place = [&](int id) {
    return std::find(flexible.node_ids.begin(), flexible.node_ids.end(), id);
  };
  const Mapping keys(value, {"nodes", "weights", "rigid"});
  const Value nodes = keys.required("nodes");
  for (const Value& item : nodes.list()) {
    const int node = read_node(item, flexible.node_ids);
    if (std::find(frame.nodes.begin(), frame.nodes.end(), node) != frame.nodes.end())
      item.refuse("the frame has this node already", "name each node once; weights let some count more");
    frame.nodes.push_back(node);
  }
  if (const auto weights = keys.optional("weights")) {
    for (const Value& item : weights->list()) frame.weights.push_back(item.positive(kRatio));
    if (frame.weights.size() != frame.nodes.size())
      weights->refuse(
          fmt::format("there are {} weights for {} nodes", frame.weights.size(), frame.nodes.size()),
          "give one weight per node, or leave them out for equal ones");
  }
  if (const auto rigid = keys.optional("rigid")) frame.rigid = rigid->boolean();

  Matrix3X position(3, static_cast<Eigen::Index>(frame.nodes.size()));
  for (std::size_t i = 0; i < frame.nodes.size(); ++i)
    position.col(static_cast<Eigen::Index>(i)) =
        flexible.node_position.col(place(frame.nodes[i]) - flexible.node_ids.begin());
  frame.centre_B = within(nodes.where(), [&] {
    return frame_geometry({name, frame.nodes, frame.weights}, position).origin;
  });
  return frame;
}

/// `mean`, or {fixed: [o, i, j]}.
std::optional<Scene::FixedAxes> read_axes(const Value& value, const std::vector<int>& node_ids) {
  if (value.is_word("mean")) return std::nullopt;
  const Mapping keys(value, {"fixed"});
  const Value fixed = keys.required("fixed");
  const std::vector<Value> items = fixed.list();
  if (items.size() != 3)
    fixed.refuse("axes are fixed on three nodes",
                 "name the node of all three directions, one along a line, one off it");
  Scene::FixedAxes nodes{};
  for (std::size_t k = 0; k < 3; ++k) {
    nodes[k] = read_node(items[k], node_ids);
  }
  return nodes;
}

/// `free`, or {held: [node, ...], centre: [x, y, z]}.
Scene::Stiffening read_stiffening(const Value& value, const Scene::Flexible& flexible) {
  if (!flexible.block && !(flexible.model && flexible.model->elements))
    value.refuse("geometric stiffening needs the stresses in the elements of the body",
                 "take its modes from a block or from listed hexahedra, or remove the key");
  if (flexible.is_rigid) value.refuse("a body without modes is rigid", "remove the key, or choose modes");
  if (flexible.identification)
    value.refuse("geometric stiffening needs the stresses of modes of a model, and these are identified",
                 "take the modes of the block or model, or remove the key");
  Scene::Stiffening stiffening;
  if (value.is_word("free")) return stiffening;
  const Mapping keys(value, {"held", "centre"});
  const Value held = keys.required("held");
  for (const Value& item : held.list()) {
    const int node = read_node(item, flexible.node_ids);
    if (std::find(stiffening.held.begin(), stiffening.held.end(), node) != stiffening.held.end())
      item.refuse("a node is listed twice", "list each node once");
    stiffening.held.push_back(node);
  }
  if (stiffening.held.size() == flexible.node_ids.size())
    held.refuse("a body that is held at every node cannot deform", "name the nodes of its support alone");
  if (stiffening.held.empty()) held.refuse("there are no nodes in the list", "name some, or write 'free'");
  if (const auto centre = keys.optional("centre")) stiffening.centre_D = centre->vector3(kLength);
  return stiffening;
}

}  // namespace

Scene::Flexible read_flexible(const Value& value, Scene& scene) {
  const Mapping keys(value, {"block", "material", "model", "modes", "below", "attachment", "constraint",
                             "damping", "axes", "inertia", "frames", "stiffening"});
  Scene::Flexible flexible;
  const Value modes = keys.required("modes");
  const bool identified =
      modes.is_mapping() && !has_any(modes, {"lowest", "below", "list", "fixed_interface"});
  take_nodes(keys, !identified, flexible, scene);
  if (identified) {
    refuse_static_shapes(keys);
    take_identification(modes, flexible, scene);
  } else {
    take_model_modes(keys, modes, flexible);
    if (const auto count = known_count(flexible))
      flexible.damping.assign(static_cast<std::size_t>(*count), 0.0);
  }
  if (const auto damping = keys.optional("damping")) {
    take_damping(*damping, identified ? std::nullopt : known_count(flexible), flexible);
    doubt_damping(*damping, scene.warnings);
  }
  if (const auto frames = keys.optional("frames"))
    for (const auto& [name, frame] : frames->named())
      flexible.frames.push_back(read_frame(name, frame, flexible));
  if (const auto stiffening = keys.optional("stiffening"))
    flexible.stiffening = read_stiffening(*stiffening, flexible);
  if (const auto axes = keys.optional("axes")) flexible.fixed_axes = read_axes(*axes, flexible.node_ids);
  if (const auto inertia = keys.optional("inertia"))
    flexible.source_terms =
        inertia->choice<bool>({{"consistent", false}, {"source", true}}, "the inertial couplings of a body");
  if (flexible.source_terms && flexible.fixed_axes)
    keys.required("inertia").refuse(
        "the terms of the source are those of mean axes: with fixed axes the coupling that "
        "they leave out is no small one",
        "write 'inertia: consistent', or 'axes: mean'");
  return flexible;
}

VectorX node_masses(const Scene::Flexible& flexible) {
  if (flexible.model) return flexible.model->node_mass;
  return lumped_mass(identification_sections::block_body(*flexible.block).mesh, flexible.block->density);
}

}  // namespace wishbone::scene_sections
