#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "identification/elements/element_edges.h"
#include "identification/elements/mesh.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/csv_table.h"
#include "models/identification_sections.h"
#include "models/scene_sections.h"

namespace wishbone::identification_sections {
namespace {

/// Nodes of elements as columns, and what their number says of the elements.
struct Elements {
  Eigen::MatrixXi nodes;
  ElementType type = ElementType::incompatible_modes;
};

std::optional<ElementType> type_of(std::size_t nodes) {
  if (nodes == 8) return ElementType::incompatible_modes;
  if (nodes == 20) return ElementType::hexahedron20;
  if (nodes == 10) return ElementType::tetrahedron10;
  return std::nullopt;
}

/// Column of every node.
std::map<int, int> columns_of(const std::vector<int>& ids) {
  std::map<int, int> columns;
  for (const int id : ids) columns.emplace(id, static_cast<int>(columns.size()));
  return columns;
}

Elements in_columns(const std::vector<std::vector<int>>& rows) {
  Elements elements;
  if (rows.empty()) return elements;
  const auto nodes = static_cast<Eigen::Index>(rows.front().size());
  elements.type = *type_of(rows.front().size());
  elements.nodes.resize(nodes, static_cast<Eigen::Index>(rows.size()));
  for (std::size_t e = 0; e < rows.size(); ++e)
    elements.nodes.col(static_cast<Eigen::Index>(e)) =
        Eigen::Map<const Eigen::VectorXi>(rows[e].data(), nodes);
  return elements;
}

/// A list of lists of nodes.
Elements listed_elements(const Value& value, const std::vector<int>& ids) {
  const std::map<int, int> columns = columns_of(ids);
  std::vector<std::vector<int>> elements;
  for (const Value& item : value.list()) {
    const std::vector<Value> nodes = item.list();
    if (!type_of(nodes.size()))
      item.refuse(fmt::format("there is no element of {} nodes", nodes.size()),
                  "write [n1, ..., n8] or [n1, ..., n20] for hexahedra, [n1, ..., n10] for tetrahedra");
    if (!elements.empty() && nodes.size() != elements.front().size())
      item.refuse(fmt::format("the elements before it have {} nodes, this one {}", elements.front().size(),
                              nodes.size()),
                  "list elements of one kind");
    std::vector<int>& element = elements.emplace_back();
    for (const Value& node : nodes) {
      const auto found =
          columns.find(node.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
      if (found == columns.end()) node.refuse("the mesh has no such node", nodes_text(ids));
      element.push_back(found->second);
    }
  }
  return in_columns(elements);
}

/// A table with the columns n1 to n8, n10 or n20; others are not read.
Elements tabled_elements(const std::filesystem::path& path, const std::vector<int>& ids) {
  const std::map<int, int> columns = columns_of(ids);
  CsvTable table(path);
  std::size_t count = 8;
  for (const std::size_t more : {10, 20})
    if (table.find(fmt::format("n{}", more))) count = more;
  std::vector<std::size_t> places;
  for (std::size_t a = 0; a < count; ++a) places.push_back(table.column(fmt::format("n{}", a + 1)));
  std::vector<std::vector<int>> elements;
  while (table.next_row()) {
    std::vector<int>& element = elements.emplace_back();
    for (const std::size_t place : places) {
      const auto found = columns.find(table.integer(place));
      if (found == columns.end()) table.reject(place, "the mesh has no such node", nodes_text(ids));
      element.push_back(found->second);
    }
  }
  return in_columns(elements);
}

/// Two elements on the same nodes would count their mass and stiffness twice.
void refuse_twins(const Value& list, const Eigen::MatrixXi& elements) {
  std::map<std::vector<int>, Eigen::Index> known;
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    std::vector<int> nodes(elements.col(e).begin(), elements.col(e).end());
    std::sort(nodes.begin(), nodes.end());
    const auto [other, is_new] = known.emplace(std::move(nodes), e);
    if (!is_new)
      list.refuse(fmt::format("element {} has the nodes of element {}", e + 1, other->second + 1),
                  "remove one of the two");
  }
}

/// `element`: which of the elements with eight nodes.
void take_kind(const Value& value, Elements& elements) {
  const auto type = value.choice<ElementType>({{"incompatible_modes", ElementType::incompatible_modes},
                                               {"mean_dilatation", ElementType::mean_dilatation}},
                                              "the hexahedra of 8 nodes");
  if (elements.type != ElementType::incompatible_modes)
    value.refuse("only hexahedra of 8 nodes come in two kinds", "remove the key");
  elements.type = type;
}

}  // namespace

MeshedBody block_body(const Scene::Block& block) {
  const IsotropicMaterial material{block.young, block.poisson, block.density};
  if (block.type != ElementType::hexahedron20)
    return {make_block(block.size, block.elements, block.type), material};
  return {with_middle_nodes(make_block(block.size, block.elements)), material};
}

AnalyticalModel mesh_model(const MeshedBody& body) {
  const Mesh& mesh = body.mesh;
  AnalyticalModel model;
  model.node_ids = mesh.node_ids;
  model.node_position = mesh.nodes;
  model.node_mass = lumped_mass(mesh, body.material.density);
  model.M = lumped_mass_matrix(model.node_mass);
  model.K = stiffness_matrix(mesh, body.material);
  model.lines = element_edges(mesh);
  model.elements = std::make_shared<const MeshedBody>(body);
  return model;
}

AnalyticalModel read_mesh(const Value& value, Files& files) {
  const Mapping keys(value, {"nodes", "elements", "element", "material"});
  const Value table = keys.required("nodes");
  NodeTable nodes = read_csv_nodes(files.note(table));
  if (nodes.mass.size() > 0)
    table.refuse("the masses of a mesh are those of its elements", "remove the column 'mass' from the table");
  const Value list = keys.required("elements");
  Elements elements =
      list.is_list() ? listed_elements(list, nodes.ids) : tabled_elements(files.note(list), nodes.ids);
  if (elements.nodes.size() == 0) list.refuse("there are no elements", "name at least one");
  refuse_twins(list, elements.nodes);
  if (const auto kind = keys.optional("element")) take_kind(*kind, elements);

  const Mesh mesh{std::move(nodes.ids), std::move(nodes.position), std::move(elements.nodes), elements.type};
  const IsotropicMaterial material = scene_sections::read_material(keys.required("material"));
  AnalyticalModel model = within(list.where(), [&] { return mesh_model({mesh, material}); });
  for (std::size_t i = 0; i < mesh.node_ids.size(); ++i)
    if (!(model.node_mass[static_cast<Eigen::Index>(i)] > 0))
      table.refuse(fmt::format("node {} belongs to no element", mesh.node_ids[i]),
                   "remove it from the table");
  return model;
}

}  // namespace wishbone::identification_sections
