#include <fmt/format.h>

#include "identification/formats/calculix_matrices.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/methods/lumping.h"
#include "models/identification_sections.h"
#include "models/scene_sections.h"

namespace wishbone::identification_sections {
namespace {

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

}  // namespace

AnalyticalModel read_model(const Value& value, Files& files) {
  const auto has = [&](const char* key) { return value.is_mapping() && value.node()->find(key); };
  if (has("block")) {
    const Mapping keys(value, {"block", "material"});
    return mesh_model(
        block_body(scene_sections::read_block(keys.required("block"), keys.required("material"))));
  }
  if (has("calculix")) return read_calculix(value, files);
  if (has("elements")) return read_mesh(value, files);
  return read_matrices(value, files);
}

}  // namespace wishbone::identification_sections
