#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

/// [Jxx, Jyy, Jzz] or [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz], components of the tensor.
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
  if (!(principal[0] > 0)) {
    value.refuse("the inertia must be positive definite: " + shown,
                 "check the signs of the products of inertia");
  }
  // J1 + J2 - J3 = 2 integral x3^2 dm >= 0; flat bodies reach zero, up to rounding
  if (principal[0] + principal[1] < (1 - 1e-9) * principal[2]) {
    value.refuse("no body can have this inertia: " + shown,
                 "the largest must not exceed the sum of the two others");
  }
  return inertia;
}

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

Scene::Flexible read_flexible(const Value& value) {
  const Mapping keys(value, {"block", "material", "modes", "damping"});
  Scene::Flexible flexible;

  const Mapping block(keys.required("block"), {"size", "elements"});
  const Value size = block.required("size");
  flexible.size = size.vector3(kLength);
  if (!(flexible.size.minCoeff() > 0))
    size.refuse("the edges of the block must be positive", "give three lengths above zero");
  const Value elements = block.required("elements");
  const std::vector<Value> counts = elements.list();
  if (counts.size() != 3) elements.refuse("three numbers of elements are wanted", "write [nx, ny, nz]");
  constexpr int kMostElements = 100;
  for (int i = 0; i < 3; ++i)
    flexible.elements[i] = counts[static_cast<std::size_t>(i)].integer(1, kMostElements);

  if (const int nodes = block_node_count(flexible); nodes > kMostNodes)
    elements.refuse(fmt::format("the block has {} nodes, more than the {} whose modes can be computed", nodes,
                                kMostNodes),
                    "take fewer elements");

  const Mapping material(keys.required("material"), {"young", "poisson", "density"});
  flexible.young = material.required("young").positive(kPressure);
  flexible.poisson = read_poisson(material.required("poisson"));
  flexible.density = material.required("density").positive(kDensity);

  const int elastic = 3 * block_node_count(flexible) - 6;
  const Value modes = keys.required("modes");
  flexible.modes = modes.is_word("all") ? elastic : modes.integer(1, elastic);
  flexible.damping.assign(static_cast<std::size_t>(flexible.modes), 0.0);
  if (const auto damping = keys.optional("damping"))
    flexible.damping = read_damping(*damping, flexible.modes);
  return flexible;
}

Scene::Body read_body_keys(const std::string& name, const Value& value) {
  const Mapping keys(value, {"mass", "inertia", "position", "orientation", "velocity", "angular_velocity",
                             "form", "flexible"});
  Scene::Body body;
  body.name = name;
  body.where = value.where();
  if (const auto form = keys.optional("form")) {
    body.form = form->choice<Scene::BodyForm>(
        {{"rigid", Scene::BodyForm::kRigid}, {"modal", Scene::BodyForm::kModal}}, "the forms of a body");
  }
  if (const auto flexible = keys.optional("flexible")) body.flexible = read_flexible(*flexible);
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

int block_node_count(const Scene::Flexible& block) {
  return (block.elements + Eigen::Vector3i::Ones()).prod();
}

Vector3 block_node_position(const Scene::Flexible& block, int node) {
  const Eigen::Vector3i nodes = block.elements + Eigen::Vector3i::Ones();
  const int in_section = (node - 1) % (nodes.y() * nodes.z());
  const int ix = (node - 1) / (nodes.y() * nodes.z());
  const int iz = in_section / nodes.y();
  const int along_row = in_section % nodes.y();
  const int iy = iz % 2 == 0 ? along_row : block.elements.y() - along_row;
  const Vector3 fraction = Vector3(ix, iy, iz).cwiseQuotient(block.elements.cast<double>());
  return block.size.cwiseProduct(fraction - Vector3::Constant(0.5));
}

int read_node(const Value& node, const Scene::Body& body) {
  if (!body.flexible) {
    node.refuse(fmt::format("the body '{}' has no nodes", body.name),
                "name a position with 'at', or give the body a 'flexible' block");
  }
  const int count = block_node_count(*body.flexible);
  const int number = node.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (number < 1 || number > count) {
    node.refuse(fmt::format("the body '{}' has no such node", body.name),
                fmt::format("its nodes are 1 to {}", count));
  }
  return number;
}

void read_bodies(const Value& section, Scene& scene) {
  for (const auto& [name, value] : section.named()) {
    if (name == "ground")
      value.refuse("'ground' is the name of the inertial frame", "give the body another name");
    scene.bodies.push_back(read_body_keys(name, value));
  }
  if (scene.bodies.empty()) section.refuse("there are no bodies", "describe at least one");
}

}  // namespace wishbone::scene_sections
