#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "identification/elements/element_edges.h"
#include "identification/elements/hexahedral_mesh.h"
#include "identification/formats/calculix_matrices.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/csv_table.h"
#include "identification/methods/lumping.h"
#include "models/identification_sections.h"
#include "models/scene_sections.h"

namespace wishbone::identification_sections {
namespace {

AnalyticalModel mesh_model(const HexahedralMesh& mesh, const IsotropicMaterial& material) {
  AnalyticalModel model;
  model.node_ids = mesh.node_ids;
  model.node_position = mesh.nodes;
  model.node_mass = lumped_mass(mesh, material.density);
  model.M = lumped_mass_matrix(model.node_mass);
  model.K = stiffness_matrix(mesh, material);
  model.lines = element_edges(mesh);
  model.elements = std::make_shared<const MeshedBody>(MeshedBody{mesh, material});
  return model;
}

/// The mass matrix; lumped, where the key says so. A matrix that is lumped already gives its nodal masses.
void take_mass(SparseMatrix M, const std::optional<Value>& lumping, const Source& where,
               AnalyticalModel& model) {
  if (!lumping) {
    if (const auto masses = nodal_masses(M)) model.node_mass = *masses;
    model.M = std::move(M);
    return;
  }
  const auto how = lumping->choice<Lumping>({{"row_sum", Lumping::row_sum}, {"diagonal", Lumping::diagonal}},
                                            "the kinds of lumping");
  model.node_mass = within(where, [&] { return lumped_masses(M, how); });
  model.M = lumped_mass_matrix(model.node_mass);
}

/// {nodes, stiffness, mass, lumping}: MatrixMarket files over the nodes of a table.
AnalyticalModel read_matrices(const Value& value, Files& files) {
  const Mapping keys(value, {"nodes", "stiffness", "mass", "lumping"});
  const NodeTable nodes = read_csv_nodes(files.note(keys.required("nodes")));
  const auto read = [&](const Value& name) {
    SparseMatrix A = read_symmetric(name, files);
    if (A.rows() != nodes.position.size())
      name.refuse(fmt::format("{} nodes have {} freedoms, this matrix has {} rows", nodes.ids.size(),
                              nodes.position.size(), A.rows()),
                  "give three freedoms to every node, in the order of the table");
    return A;
  };
  AnalyticalModel model;
  model.node_ids = nodes.ids;
  model.node_position = nodes.position;
  model.K = read(keys.required("stiffness"));
  if (const auto mass = keys.optional("mass")) {
    take_mass(read(*mass), keys.optional("lumping"), mass->where(), model);
  } else if (nodes.mass.size() > 0) {
    model.node_mass = nodes.mass;
    model.M = lumped_mass_matrix(nodes.mass);
  } else {
    keys.refuse("the masses of the model are not known",
                "add 'mass: M.mtx', or a column 'mass' to the nodes");
  }
  return model;
}

/// {calculix, nodes, lumping}: what a job of CalculiX stored.
AnalyticalModel read_calculix(const Value& value, Files& files) {
  const Mapping keys(value, {"calculix", "nodes", "lumping"});
  const Value name = keys.required("calculix");
  const auto nodes = keys.optional("nodes");
  const std::filesystem::path job = files.note(name, {".dof", ".sti", ".mas"});
  std::filesystem::path deck = job.string() + ".inp";
  if (nodes)
    deck = files.note(*nodes);
  else
    files.note(name, {".inp"});
  CalculixMatrices matrices = read_calculix_matrices(job, deck);
  AnalyticalModel model;
  model.node_ids = std::move(matrices.node_ids);
  model.node_position = std::move(matrices.node_position);
  model.K = std::move(matrices.K);
  take_mass(std::move(matrices.M), keys.optional("lumping"), name.where(), model);
  return model;
}

/// Columns of the corners of one element among the nodes.
using Corners = std::array<int, 8>;

/// Column of every node.
std::map<int, int> columns_of(const std::vector<int>& ids) {
  std::map<int, int> columns;
  for (const int id : ids) columns.emplace(id, static_cast<int>(columns.size()));
  return columns;
}

/// A list of lists of eight nodes.
std::vector<Corners> listed_elements(const Value& value, const std::vector<int>& ids) {
  const std::map<int, int> columns = columns_of(ids);
  std::vector<Corners> elements;
  for (const Value& item : value.list()) {
    const std::vector<Value> nodes = item.list();
    if (nodes.size() != 8) item.refuse("a hexahedron has eight nodes", "write [n1, n2, ..., n8]");
    Corners& corners = elements.emplace_back();
    for (std::size_t a = 0; a < 8; ++a) {
      const auto found =
          columns.find(nodes[a].integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
      if (found == columns.end()) nodes[a].refuse("the mesh has no such node", nodes_text(ids));
      corners[a] = found->second;
    }
  }
  return elements;
}

/// A table with the columns n1 to n8; others are not read.
std::vector<Corners> tabled_elements(const std::filesystem::path& path, const std::vector<int>& ids) {
  const std::map<int, int> columns = columns_of(ids);
  CsvTable table(path);
  std::array<std::size_t, 8> places{};
  for (std::size_t a = 0; a < 8; ++a) places[a] = table.column(fmt::format("n{}", a + 1));
  std::vector<Corners> elements;
  while (table.next_row()) {
    Corners& corners = elements.emplace_back();
    for (std::size_t a = 0; a < 8; ++a) {
      const auto found = columns.find(table.integer(places[a]));
      if (found == columns.end()) table.reject(places[a], "the mesh has no such node", nodes_text(ids));
      corners[a] = found->second;
    }
  }
  return elements;
}

/// Two elements on the same eight nodes would count their mass and stiffness twice.
void refuse_twins(const Value& list, const std::vector<Corners>& elements) {
  std::map<Corners, std::size_t> known;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    Corners nodes = elements[e];
    std::sort(nodes.begin(), nodes.end());
    const auto [other, is_new] = known.emplace(nodes, e);
    if (!is_new)
      list.refuse(fmt::format("element {} has the nodes of element {}", e + 1, other->second + 1),
                  "remove one of the two");
  }
}

/// {nodes, elements, material}: listed hexahedra.
AnalyticalModel read_mesh(const Value& value, Files& files) {
  const Mapping keys(value, {"nodes", "elements", "material"});
  const Value table = keys.required("nodes");
  NodeTable nodes = read_csv_nodes(files.note(table));
  if (nodes.mass.size() > 0)
    table.refuse("the masses of a mesh are those of its elements", "remove the column 'mass' from the table");
  const Value list = keys.required("elements");
  const std::vector<Corners> elements =
      list.is_list() ? listed_elements(list, nodes.ids) : tabled_elements(files.note(list), nodes.ids);
  if (elements.empty()) list.refuse("there are no elements", "name at least one");
  refuse_twins(list, elements);

  HexahedralMesh mesh{std::move(nodes.ids), std::move(nodes.position), {}};
  mesh.elements.resize(8, static_cast<Eigen::Index>(elements.size()));
  for (std::size_t e = 0; e < elements.size(); ++e)
    mesh.elements.col(static_cast<Eigen::Index>(e)) =
        Eigen::Map<const Eigen::Matrix<int, 8, 1>>(elements[e].data());
  const IsotropicMaterial material = scene_sections::read_material(keys.required("material"));
  AnalyticalModel model = within(list.where(), [&] { return mesh_model(mesh, material); });
  for (std::size_t i = 0; i < mesh.node_ids.size(); ++i)
    if (!(model.node_mass[static_cast<Eigen::Index>(i)] > 0))
      table.refuse(fmt::format("node {} belongs to no element", mesh.node_ids[i]),
                   "remove it from the table");
  return model;
}

}  // namespace

AnalyticalModel block_model(const Vector3& size, const Eigen::Vector3i& elements, double young,
                            double poisson, double density) {
  return mesh_model(make_block(size, elements), {young, poisson, density});
}

AnalyticalModel read_model(const Value& value, Files& files) {
  const auto has = [&](const char* key) { return value.is_mapping() && value.node()->find(key); };
  if (has("block")) {
    const Mapping keys(value, {"block", "material"});
    const Scene::Block block = scene_sections::read_block(keys.required("block"), keys.required("material"));
    return block_model(block.size, block.elements, block.young, block.poisson, block.density);
  }
  if (has("calculix")) return read_calculix(value, files);
  if (has("elements")) return read_mesh(value, files);
  return read_matrices(value, files);
}

}  // namespace wishbone::identification_sections
