#include "models/identification_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

#include "identification/formats/matrix_market.h"
#include "identification/formats/modal_file.h"
#include "models/scene_sections.h"

namespace wishbone::identification_sections {
namespace {

constexpr int kLargestId = std::numeric_limits<int>::max();

int read_id(const Value& value) {
  return value.integer(std::numeric_limits<int>::min(), kLargestId);
}

/// One stiffness for x, y and z, or one each; zero: none in that direction.
Vector3 read_stiffnesses(const Value& value) {
  if (!value.is_list()) return Vector3::Constant(value.positive(kStiffness));
  const Vector3 k = value.vector3(kStiffness);
  if (!(k.minCoeff() >= 0 && k.maxCoeff() > 0))
    value.refuse("the stiffnesses of a spring must not be negative, nor all zero", "write [kx, ky, kz]");
  return k;
}

void read_springs(const Value& item, Support& support) {
  const Mapping keys(item, {"node", "nodes", "stiffness", "direction"});
  const std::vector<int> nodes = read_nodes(keys);
  const Value stiffness = keys.required("stiffness");
  const auto direction = keys.optional("direction");
  for (const int node : nodes) {
    if (direction) {
      support.springs.push_back({node, direction->direction(), stiffness.positive(kStiffness)});
      continue;
    }
    const Vector3 k = read_stiffnesses(stiffness);
    for (int axis = 0; axis < 3; ++axis)
      if (k[axis] > 0) support.springs.push_back({node, Vector3::Unit(axis), k[axis]});
  }
}

void read_joints(const Value& item, Support& support) {
  const Mapping keys(item, {"node", "nodes", "axes", "direction"});
  const auto direction = keys.optional("direction");
  if (direction && keys.has("axes"))
    keys.refuse("a joint has either axes or a direction", "remove one of the two");
  for (const int node : read_nodes(keys)) {
    if (direction) {
      support.joints.push_back({node, direction->direction()});
      continue;
    }
    const Value axes = keys.required("axes");
    const std::string& letters = axes.text();
    const bool known = !letters.empty() && letters.find_first_not_of("xyz") == std::string::npos;
    std::string sorted = letters;
    std::sort(sorted.begin(), sorted.end());
    if (!known || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      axes.refuse("the axes of a joint are letters out of x, y, z, each once", "write 'xyz', 'z', ...");
    for (const char letter : letters) support.joints.push_back({node, Vector3::Unit(letter - 'x')});
  }
}

std::vector<Support::Mass> read_masses(const Value& list, bool of_any_sign) {
  std::vector<Support::Mass> masses;
  for (const Value& item : list.list()) {
    const Mapping keys(item, {"node", "nodes", "mass"});
    const Value mass = keys.required("mass");
    for (const int node : read_nodes(keys))
      masses.push_back({node, of_any_sign ? mass.number(kMass) : mass.non_negative(kMass)});
  }
  return masses;
}

StructureChange::Spring read_connection(const Value& item, const std::vector<int>& ids,
                                        const Matrix3X& position) {
  const Mapping keys(item, {"nodes", "stiffness", "direction"});
  const Value nodes = keys.required("nodes");
  const std::vector<Value> ends = nodes.list();
  if (ends.size() != 2) nodes.refuse("a spring of a design change joins two nodes", "write nodes: [a, b]");
  StructureChange::Spring spring;
  spring.nodes = {read_id(ends[0]), read_id(ends[1])};
  spring.stiffness = keys.required("stiffness").number(kStiffness);
  if (const auto direction = keys.optional("direction")) {
    spring.direction = direction->direction();
    return spring;
  }
  const auto place = [&](const Value& node) -> Vector3 {
    const auto found = std::find(ids.begin(), ids.end(), read_id(node));
    if (found == ids.end()) node.refuse("the structure has no such node", nodes_text(ids));
    return position.col(found - ids.begin());
  };
  const Vector3 along = place(ends[1]) - place(ends[0]);
  if (!(along.norm() > 0))
    nodes.refuse("the two nodes are in one place, so that a direction must be given",
                 "add 'direction: [x, y, z]'");
  spring.direction = along.normalized();
  return spring;
}

std::filesystem::path path_of(const Value& name) {
  const Source& where = name.where();
  const std::filesystem::path folder = where.file ? std::filesystem::path(*where.file).parent_path() : "";
  return (folder / name.text()).lexically_normal();
}

/// What stands under `node` or `nodes`.
std::vector<Value> node_values(const Value& item) {
  const Mapping keys(item, {"node", "nodes", "stiffness", "direction", "axes", "mass"});
  if (const auto node = keys.optional("node")) return {*node};
  return keys.required("nodes").list();
}

}  // namespace

void Files::add(const std::filesystem::path& path, const Value& name) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown))
    name.refuse(fmt::format("there is no file {}", path.string()),
                "names are relative to the file that they stand in");
  read_.push_back(path.string());
}

std::filesystem::path Files::note(const Value& name) {
  const std::filesystem::path path = path_of(name);
  add(path, name);
  return path;
}

std::filesystem::path Files::note(const Value& name, std::initializer_list<const char*> extensions) {
  const std::filesystem::path path = path_of(name);
  for (const char* extension : extensions) add(path.string() + extension, name);
  return path;
}

std::filesystem::path Files::note_modal_data(const Value& name) {
  const std::filesystem::path path = path_of(name);
  for (const auto& file : within(name.where(), [&] { return modal_data_files(path); })) add(file, name);
  return path;
}

std::string nodes_text(const std::vector<int>& ids) {
  const auto [first, last] = std::minmax_element(ids.begin(), ids.end());
  const bool gapless = *last - *first + 1 == static_cast<int>(ids.size());
  return gapless ? fmt::format("its nodes are {} to {}", *first, *last)
                 : fmt::format("it has {} nodes between {} and {}", ids.size(), *first, *last);
}

void check_nodes(const Value& section, const std::vector<int>& ids) {
  const Mapping parts(section, {"springs", "joints", "masses", "mass_matrix", "stiffness_matrix"});
  for (const char* part : {"springs", "joints", "masses"}) {
    const auto list = parts.optional(part);
    if (!list) continue;
    for (const Value& item : list->list())
      for (const Value& node : node_values(item))
        if (std::find(ids.begin(), ids.end(), read_id(node)) == ids.end())
          node.refuse("the structure has no such node", nodes_text(ids));
  }
}

std::vector<int> read_nodes(const Mapping& keys) {
  const auto one = keys.optional("node");
  const auto several = keys.optional("nodes");
  if (one.has_value() == several.has_value())
    keys.refuse("either 'node' or 'nodes' says where it is", "write 'node: 3' or 'nodes: [3, 4]'");
  if (one) return {read_id(*one)};
  std::vector<int> nodes;
  for (const Value& item : several->list()) nodes.push_back(read_id(item));
  if (nodes.empty()) several->refuse("there are no nodes in the list", "name at least one");
  return nodes;
}

Support read_support(const Value& value) {
  const Mapping keys(value, {"springs", "joints", "masses"});
  Support support;
  if (const auto springs = keys.optional("springs"))
    for (const Value& item : springs->list()) read_springs(item, support);
  if (const auto joints = keys.optional("joints"))
    for (const Value& item : joints->list()) read_joints(item, support);
  if (const auto masses = keys.optional("masses")) support.masses = read_masses(*masses, false);
  return support;
}

SparseMatrix read_symmetric(const Value& name, Files& files) {
  const std::filesystem::path path = files.note(name);
  SparseMatrix A = read_matrix_market(path);
  if (A.rows() != A.cols())
    name.refuse(fmt::format("the matrix must be square, this one has {} x {}", A.rows(), A.cols()),
                "give a row and a column for every freedom");
  const SparseMatrix transposed = A.transpose();
  if (const double asymmetry = (A - transposed).norm(); !(asymmetry <= 1e-8 * A.norm()))
    name.refuse(fmt::format("the matrix must be symmetric, its asymmetry is {:.2g}", asymmetry / A.norm()),
                "take its symmetric part if the difference is noise");
  return A;
}

StructureChange read_change(const Value& value, const std::vector<int>& ids, const Matrix3X& position,
                            Files& files) {
  const Mapping keys(value, {"masses", "springs", "mass_matrix", "stiffness_matrix"});
  StructureChange change;
  if (const auto masses = keys.optional("masses")) change.masses = read_masses(*masses, true);
  if (const auto springs = keys.optional("springs"))
    for (const Value& item : springs->list()) change.springs.push_back(read_connection(item, ids, position));
  if (const auto matrix = keys.optional("mass_matrix")) change.dM = read_symmetric(*matrix, files);
  if (const auto matrix = keys.optional("stiffness_matrix")) change.dK = read_symmetric(*matrix, files);
  if (change.empty()) keys.refuse("there is no change", "name masses, springs or matrices");
  return change;
}

MeasurementNoise read_noise(const Value& value) {
  const Mapping keys(value, {"frequencies", "shapes", "samples", "seed"});
  MeasurementNoise noise;
  if (const auto frequencies = keys.optional("frequencies"))
    noise.frequency = frequencies->non_negative(kRatio);
  if (const auto shapes = keys.optional("shapes")) noise.shape = shapes->non_negative(kRatio);
  if (const auto samples = keys.optional("samples")) noise.samples = samples->integer(2, 1000000);
  if (const auto seed = keys.optional("seed"))
    noise.seed = static_cast<unsigned>(seed->integer(0, kLargestId));
  constexpr double kMostShapeScatter = 0.1;  // beyond it no motion is told from rigid-body motion
  if (noise.shape >= kMostShapeScatter)
    keys.required("shapes").refuse("shapes that scatter this much tell nothing of elastic modes",
                                   "give less than 10 %");
  if (noise.frequency == 0 && noise.shape == 0)
    keys.refuse("there is no noise", "give 'frequencies' or 'shapes' a standard deviation, as '0.1 %'");
  return noise;
}

RigidBodyData read_rigid_body(const Value& value) {
  const Mapping keys(value, {"total", "centre", "inertia"});
  return {keys.required("total").positive(kMass), keys.required("centre").vector3(kLength),
          scene_sections::read_inertia(keys.required("inertia"))};
}

ModalData choose_modes(const Value& value, const ModalData& modes) {
  if (value.is_word("all")) return modes;
  std::vector<int> chosen;
  if (value.is_list()) {
    for (const Value& item : value.list()) chosen.push_back(item.integer(1, modes.mode_count()) - 1);
    std::sort(chosen.begin(), chosen.end());
    if (std::adjacent_find(chosen.begin(), chosen.end()) != chosen.end())
      value.refuse("a mode is listed twice", "list each mode once");
  } else if (value.is_mapping()) {
    const Mapping range(value, {"above", "below"});
    const auto limit = [&](const char* key, double otherwise) {
      const auto frequency = range.optional(key);
      return frequency ? 2 * std::numbers::pi * frequency->positive(kFrequency) : otherwise;
    };
    const double above = limit("above", 0), below = limit("below", std::numeric_limits<double>::infinity());
    for (int j = 0; j < modes.mode_count(); ++j)
      if (modes.omega[j] >= above && modes.omega[j] <= below) chosen.push_back(j);
  } else {
    chosen.resize(static_cast<std::size_t>(value.integer(1, modes.mode_count())));
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  if (chosen.empty())
    value.refuse("no mode is chosen", fmt::format("there are {} modes", modes.mode_count()));
  return modes.with_modes(chosen);
}

}  // namespace wishbone::identification_sections
