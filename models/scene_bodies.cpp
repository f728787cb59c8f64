#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "bodies/interface_frame.h"
#include "identification/body_nodes.h"
#include "identification/elements/hexahedral_mesh.h"
#include "models/identification_loader.h"
#include "models/identification_sections.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

double read_poisson(const Value& value) {
  const double poisson = value.number(kRatio);
  if (!(poisson > -1 && poisson < 0.5))
    value.refuse("Poisson's ratio must be between -1 and 0.5", "metals have 0.3");
  return poisson;
}

/// One ratio for all modes, or one per kept mode.
std::vector<double> read_damping(const Value& value, int modes) {
  if (!value.is_list())
    return std::vector<double>(static_cast<std::size_t>(modes), value.non_negative(kRatio));
  std::vector<double> ratios;
  for (const Value& item : value.list()) ratios.push_back(item.non_negative(kRatio));
  if (ratios.size() != static_cast<std::size_t>(modes)) {
    value.refuse(fmt::format("there are {} damping ratios for {} modes", ratios.size(), modes),
                 "give one ratio for all modes, or one per mode");
  }
  return ratios;
}

/// The modes of a block come from a dense eigenproblem of three freedoms a node, whose cost grows with the cube.
constexpr int kMostNodes = 500;

void take_block(const Scene::Block& block, Scene::Flexible& flexible) {
  const HexahedralMesh mesh = make_block(block.size, block.elements);
  flexible.block = block;
  flexible.node_ids = mesh.node_ids;
  flexible.node_position = mesh.nodes;
}

void take_lowest_modes(const Value& modes, const std::optional<Value>& damping, Scene::Flexible& flexible) {
  const int elastic = 3 * static_cast<int>(flexible.node_ids.size()) - 6;
  flexible.modes = modes.is_word("all") ? elastic : modes.integer(1, elastic);
  flexible.damping.assign(static_cast<std::size_t>(flexible.modes), 0.0);
  if (damping) flexible.damping = read_damping(*damping, flexible.modes);
}

/// The modes are identified, and the nodes with them; a block is the model unless the identification has its own.
void take_identification(const Value& section, Scene::Flexible& flexible, Scene& scene) {
  std::optional<AnalyticalModel> model;
  if (flexible.block) {
    const Scene::Block& b = *flexible.block;
    model = identification_sections::block_model(b.size, b.elements, b.young, b.poisson, b.density);
  }
  LoadedIdentification loaded = read_identification(section, model ? &*model : nullptr);
  if (loaded.task.goal == Goal::kHeld)
    section.refuse("a flexible body needs free-free modes", "write 'find: free', 'changed' or 'corrected'");
  const BodyNodes nodes = within(section.where(), [&] { return body_nodes(loaded.task); });
  flexible.node_ids = nodes.ids;
  flexible.node_position = nodes.position;
  scene.data_files.insert(scene.data_files.end(), loaded.files.begin(), loaded.files.end());
  flexible.identification = std::make_shared<const IdentificationTask>(std::move(loaded.task));
}

/// One ratio for all modes or a list, whose length is known to be right when the modes have been identified.
void take_identified_damping(const Value& value, Scene::Flexible& flexible) {
  if (!value.is_list()) {
    flexible.identified_damping = value.non_negative(kRatio);
    return;
  }
  for (const Value& item : value.list()) flexible.damping.push_back(item.non_negative(kRatio));
  if (flexible.damping.empty())
    value.refuse("there are no damping ratios in the list", "remove the key to keep those of the modes");
}

/// {nodes: [...], weights: [...]}.
Scene::Frame read_frame(const std::string& name, const Value& value, const Scene::Flexible& flexible) {
  Scene::Frame frame;
  frame.name = name;
  const auto place = [&](int id) {
    return std::find(flexible.node_ids.begin(), flexible.node_ids.end(), id);
  };
  const Mapping keys(value, {"nodes", "weights"});
  const Value nodes = keys.required("nodes");
  for (const Value& item : nodes.list()) {
    const int node = item.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
    if (place(node) == flexible.node_ids.end())
      item.refuse("the body has no such node", identification_sections::nodes_text(flexible.node_ids));
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

  Matrix3X position(3, static_cast<Eigen::Index>(frame.nodes.size()));
  for (std::size_t i = 0; i < frame.nodes.size(); ++i)
    position.col(static_cast<Eigen::Index>(i)) =
        flexible.node_position.col(place(frame.nodes[i]) - flexible.node_ids.begin());
  frame.centre_B = within(nodes.where(), [&] {
    return frame_geometry({name, frame.nodes, frame.weights}, position).origin;
  });
  return frame;
}

/// Where the modes and the nodes come from.
Scene::Flexible read_modes(const Mapping& keys, Scene& scene) {
  Scene::Flexible flexible;
  const Value modes = keys.required("modes");
  if (!modes.is_mapping() || keys.has("block"))
    take_block(read_block(keys.required("block"), keys.required("material")), flexible);
  const auto damping = keys.optional("damping");
  if (!modes.is_mapping()) {
    take_lowest_modes(modes, damping, flexible);
    return flexible;
  }
  take_identification(modes, flexible, scene);
  if (damping) take_identified_damping(*damping, flexible);
  return flexible;
}

Scene::Flexible read_flexible(const Value& value, Scene& scene) {
  const Mapping keys(value, {"block", "material", "modes", "damping", "frames"});
  Scene::Flexible flexible = read_modes(keys, scene);
  if (const auto frames = keys.optional("frames"))
    for (const auto& [name, frame] : frames->named())
      flexible.frames.push_back(read_frame(name, frame, flexible));
  return flexible;
}

Scene::Body read_body_keys(const std::string& name, const Value& value, Scene& scene) {
  const Mapping keys(value, {"mass", "inertia", "position", "orientation", "velocity", "angular_velocity",
                             "form", "flexible"});
  Scene::Body body;
  body.name = name;
  body.where = value.where();
  if (const auto form = keys.optional("form")) {
    body.form = form->choice<Scene::BodyForm>(
        {{"rigid", Scene::BodyForm::kRigid}, {"modal", Scene::BodyForm::kModal}}, "the forms of a body");
  }
  if (const auto flexible = keys.optional("flexible")) body.flexible = read_flexible(*flexible, scene);
  const bool modal = body.form == Scene::BodyForm::kModal;
  if (modal && !body.flexible) {
    keys.refuse("a modal body needs the key 'flexible'",
                "add 'flexible: {block: ..., material: ..., modes: ...}'");
  }
  if (!modal || keys.has("mass")) body.mass = keys.required("mass").positive(kMass);
  if (!modal || keys.has("inertia")) body.inertia = read_inertia(keys.required("inertia"));

  body.X_DB.p = keys.required("position").vector3(kLength);
  if (const auto orientation = keys.optional("orientation")) {
    const Mapping turn(*orientation, {"axis", "angle"});
    body.X_DB.R = read_rotation(turn.required("axis"), turn.required("angle"));
  }
  if (const auto velocity = keys.optional("velocity")) body.v_WBo = velocity->vector3(kVelocity);
  if (const auto rate = keys.optional("angular_velocity")) body.w_WB_B = rate->vector3(kAngularVelocity);
  return body;
}

}  // namespace

Matrix3 read_rotation(const Value& axis, const Value& angle) {
  return quaternion_from_rotation_vector(angle.number(kAngle) * axis.direction()).toRotationMatrix();
}

Matrix3 read_inertia(const Value& value) {
  const std::vector<Value> items = value.list();
  if (items.size() != 3 && items.size() != 6) {
    value.refuse("the inertia must have three or six components",
                 "write [Jxx, Jyy, Jzz] or [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz]");
  }
  Vector6 J = Vector6::Zero();
  for (std::size_t i = 0; i < items.size(); ++i) J[static_cast<Eigen::Index>(i)] = items[i].number(kInertia);
  Matrix3 inertia;
  inertia << J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2];

  const Vector3 principal =
      Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string shown = fmt::format("its principal values are {:.6g}, {:.6g}, {:.6g} kg m2", principal[0],
                                        principal[1], principal[2]);
  // point masses and thin rods reach zero, up to rounding
  constexpr double kRounding = 1e-9;
  if (!(principal[0] >= -kRounding * std::abs(principal[2]))) {
    value.refuse("the inertia must not be negative: " + shown, "check the signs of the products of inertia");
  }
  // J1 + J2 - J3 = 2 integral x3^2 dm >= 0; flat bodies reach zero, up to rounding
  if (principal[0] + principal[1] < (1 - kRounding) * principal[2]) {
    value.refuse("no body can have this inertia: " + shown,
                 "the largest must not exceed the sum of the two others");
  }
  return inertia;
}

Scene::Block read_block(const Value& value, const Value& material_value) {
  Scene::Block block;
  const Mapping keys(value, {"size", "elements"});
  const Value size = keys.required("size");
  block.size = size.vector3(kLength);
  if (!(block.size.minCoeff() > 0))
    size.refuse("the edges of the block must be positive", "give three lengths above zero");
  const Value elements = keys.required("elements");
  const std::vector<Value> counts = elements.list();
  if (counts.size() != 3) elements.refuse("three numbers of elements are wanted", "write [nx, ny, nz]");
  constexpr int kMostElements = 100;
  for (int i = 0; i < 3; ++i)
    block.elements[i] = counts[static_cast<std::size_t>(i)].integer(1, kMostElements);
  if (const int nodes = (block.elements + Eigen::Vector3i::Ones()).prod(); nodes > kMostNodes)
    elements.refuse(fmt::format("the block has {} nodes, more than the {} whose modes can be computed", nodes,
                                kMostNodes),
                    "take fewer elements");

  const Mapping material(material_value, {"young", "poisson", "density"});
  block.young = material.required("young").positive(kPressure);
  block.poisson = read_poisson(material.required("poisson"));
  block.density = material.required("density").positive(kDensity);
  return block;
}

Vector3 node_place(const Scene::Body& body, int node) {
  const std::vector<int>& ids = body.flexible->node_ids;
  const auto index = std::find(ids.begin(), ids.end(), node) - ids.begin();
  return body.X_DB * Vector3(body.flexible->node_position.col(index));
}

int read_node(const Value& node, const Scene::Body& body) {
  if (!body.flexible) {
    node.refuse(fmt::format("the body '{}' has no nodes", body.name),
                "name a position with 'at', or give the body a 'flexible' block");
  }
  const std::vector<int>& ids = body.flexible->node_ids;
  const int number = node.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (std::find(ids.begin(), ids.end(), number) == ids.end()) {
    node.refuse(fmt::format("the body '{}' has no such node", body.name),
                identification_sections::nodes_text(ids));
  }
  return number;
}

Vector3 frame_place(const Scene::Body& body, int frame) {
  return body.X_DB * body.flexible->frames[static_cast<std::size_t>(frame)].centre_B;
}

int read_frame_name(const Value& frame, const Scene::Body& body) {
  if (!body.flexible || body.flexible->frames.empty()) {
    frame.refuse(fmt::format("the body '{}' has no frames", body.name),
                 "describe it under 'frames' of its 'flexible'");
  }
  return index_of(body.flexible->frames, frame, fmt::format("the frames of '{}'", body.name));
}

void read_bodies(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    if (name == "ground")
      value.refuse("'ground' is the name of the inertial frame", "give the body another name");
    scene.bodies.push_back(read_body_keys(name, value, scene));
  }
  if (scene.bodies.empty()) section.refuse("there are no bodies", "describe at least one");
}

}  // namespace wishbone::scene_sections
