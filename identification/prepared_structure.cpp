#include "identification/prepared_structure.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "core/error.h"
#include "identification/held_freedoms.h"
#include "identification/measurement_noise.h"
#include "identification/methods/expansion.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/support_matrices.h"
#include "identification/unheld_modes.h"

namespace wishbone {
namespace {

/// Rows of the measured freedoms in the model, whose nodes have the same ids.
std::vector<int> rows_in_model(const ModalData& data, const AnalyticalModel& model) {
  std::map<int, int> place;
  for (std::size_t i = 0; i < model.node_ids.size(); ++i) place[model.node_ids[i]] = static_cast<int>(i);
  std::vector<int> rows;
  for (const Freedom& freedom : data.freedoms) {
    const auto found = place.find(freedom.node);
    if (found == place.end())
      throw InputError({"identification", "the model has no such node", to_string(freedom),
                        "number the measured points as the nodes of the model"});
    rows.push_back(3 * found->second + freedom.axis);
  }
  return rows;
}

/// Equal numbers should mean equal places.
void warn_of_places(const ModalData& data, const AnalyticalModel& model, const std::vector<int>& rows,
                    std::vector<std::string>& warnings) {
  constexpr double kFar = 1e-2;  // of the size of the model
  double farthest = 0;
  int node = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int id = data.freedoms[i].node;
    const double distance =
        (data.node_position.col(data.node_index(id)) - model.node_position.col(rows[i] / 3)).norm();
    if (distance <= farthest) continue;
    farthest = distance;
    node = id;
  }
  const double size =
      (model.node_position.rowwise().maxCoeff() - model.node_position.rowwise().minCoeff()).norm();
  if (farthest > kFar * size)
    warnings.push_back(
        fmt::format("node {} of the model lies {:.2g} m from where it was measured: check the numbering and "
                    "the axes",
                    node, farthest));
}

/// Shapes of the model that span what was measured: its own on the same support, rigid motion among them, six more than
/// were measured but no more than the measured freedoms can tell apart.
MatrixX serep_basis(const ModalData& data, const AnalyticalModel& model, const std::vector<int>& rows,
                    PreparedStructure& out) {
  const SupportMatrices support = support_matrices(data.support, model.freedoms());
  auto count = std::min<Eigen::Index>(data.freedom_count(), data.mode_count() + 6);
  Modes basis = model_modes(model.K, model.M, support, count);
  while (count > data.mode_count()) {
    const Eigen::Index told_apart = serep_rank(basis.shapes, rows);
    if (told_apart == count) break;
    count = std::max<Eigen::Index>(told_apart, data.mode_count());
    basis = basis.lowest(count);
  }
  out.notes.push_back(
      fmt::format("expanded by SEREP from {} measured freedoms to {} with {} modes of the model",
                  data.freedom_count(), model.M.rows(), basis.count()));
  return basis.shapes;
}

MatrixX static_basis(const ModalData& data, const AnalyticalModel& model, const std::vector<int>& rows) {
  const SupportMatrices support = support_matrices(data.support, model.freedoms());
  return static_transformation(model.K + support.K_s, support.D, rows);
}

/// The data with the shapes of all freedoms of the model.
void take_model_freedoms(const AnalyticalModel& model, MatrixX shapes, ModalData& data) {
  data.node_ids = model.node_ids;
  data.node_position = model.node_position;
  data.node_mass = model.node_mass;
  data.freedoms = model.freedoms();
  data.shapes = std::move(shapes);
  if (!model.lines.empty()) data.lines = model.lines;
}

void cover(const IdentificationTask& task, PreparedStructure& out) {
  if (task.coverage == Coverage::kAsMeasured) return;
  if (!task.model)
    throw InputError(
        {"identification", "expansion and reduction need a model", "none was given", "name its M and K"});
  const AnalyticalModel& model = *task.model;
  const std::vector<int> rows = rows_in_model(out.data, model);
  warn_of_places(out.data, model, rows, out.warnings);
  if (task.coverage == Coverage::kGuyan && (task.mass || task.rigid_body))
    throw InputError({"identification",
                      "the masses are those of the model, reduced by Guyan, and given besides", "",
                      "give no other masses, or expand the modes to the model (expansion: serep or static)"});
  switch (task.coverage) {
    case Coverage::kAsMeasured:
      break;
    case Coverage::kSerep:
      take_model_freedoms(model, expand_serep(serep_basis(out.data, model, rows, out), rows, out.data.shapes),
                          out.data);
      break;
    case Coverage::kStatic:
      take_model_freedoms(model, static_basis(out.data, model, rows) * out.data.shapes, out.data);
      out.notes.push_back(
          fmt::format("expanded statically from {} measured freedoms to {}", rows.size(), model.M.rows()));
      break;
    case Coverage::kGuyan:
      out.M = reduced(model.M, static_basis(out.data, model, rows)).sparseView();
      out.data.node_mass.resize(0);
      out.notes.push_back(fmt::format("mass of {} freedoms reduced to the {} measured ones (Guyan)",
                                      model.M.rows(), rows.size()));
      break;
  }
  if (out.M.size() == 0 && !task.mass) out.M = model.M;
  out.data.provenance.push_back(out.notes.back());
}

/// Returns the number of masses that the orthogonality of the modes decided.
int find_masses(const RigidBodyData& body, PreparedStructure& out) {
  ModalData& data = out.data;
  const MassDistribution found = distribute_mass(body, data.node_position, data.shapes,
                                                 support_matrices(data.support, data.freedoms).M_s);
  data.node_mass = found.node_mass;
  const std::string note =
      fmt::format("nodal masses from {} equations for {} nodes: rank {}, relative residual {:.2e}",
                  found.equations, data.node_count(), found.rank, found.residual);
  out.notes.push_back(note);
  data.provenance.push_back(note);
  if (found.rank < data.node_count())
    out.warnings.push_back(
        fmt::format("the equations leave {} of {} nodal masses open: those of least norm were taken",
                    data.node_count() - found.rank, data.node_count()));
  if (found.residual > 1e-2)
    out.warnings.push_back(fmt::format(
        "no nodal masses fit the mass data and the modes: relative residual {:.1e}", found.residual));
  constexpr int kOfTheBody = 10;  // mass, centre, inertia
  return std::max(0, found.rank - kOfTheBody);
}

/// Lumped masses over the freedoms; every node with mass must be seen.
SparseMatrix lumped(const ModalData& data) {
  if (!data.has_masses())
    throw InputError(
        {"identification", "the masses of the nodes are not known",
         fmt::format("{} nodes", data.node_count()),
         "give a column 'mass' with the nodes, a mass matrix, or mass, centre and inertia of the body"});
  std::set<int> seen;
  VectorX diagonal(data.freedom_count());
  for (int i = 0; i < data.freedom_count(); ++i) {
    const Freedom& freedom = data.freedoms[static_cast<std::size_t>(i)];
    diagonal[i] = data.node_mass[data.node_index(freedom.node)];
    seen.insert(freedom.node);
    if (!(diagonal[i] > 0))
      throw InputError({"identification", "every measured freedom must have mass",
                        to_string(freedom) + " has none",
                        "leave massless points out of the modes, or expand them to a model"});
  }
  for (int i = 0; i < data.node_count(); ++i)
    if (data.node_mass[i] > 0 && !seen.contains(data.node_ids[static_cast<std::size_t>(i)]))
      throw InputError(
          {"identification", "a node with mass was not measured",
           fmt::format("node {}", data.node_ids[static_cast<std::size_t>(i)]),
           "lump its mass on its neighbours, or expand the measurement to a model (expansion: serep or "
           "static)"});
  return diagonal_matrix(diagonal);
}

/// Returns the number of masses that were fitted to the modes.
int set_up_mass(const IdentificationTask& task, PreparedStructure& out) {
  const int fitted = task.rigid_body ? find_masses(*task.rigid_body, out) : 0;
  if (out.M.size() == 0 || task.rigid_body) out.M = task.mass ? *task.mass : lumped(out.data);
  const Eigen::Index n = out.data.freedom_count();
  if (out.M.rows() != n || out.M.cols() != n)
    throw InputError({"identification",
                      "the mass matrix must have a row and a column for every freedom of the modes",
                      fmt::format("{} x {} for {} freedoms", out.M.rows(), out.M.cols(), n),
                      "give both for the same freedoms in the same order, or name the model in 'expansion'"});
  return fitted;
}

void warn_of_directions(const ModalData& data, std::vector<std::string>& warnings) {
  if (data.is_complete()) return;
  warnings.push_back(fmt::format(
      "{} of {} freedoms of {} nodes were measured: the result is a model of these directions alone, "
      "not a body that can move in space",
      data.freedom_count(), 3 * data.node_count(), data.node_count()));
}

}  // namespace

PreparedStructure prepare(const IdentificationTask& task) {
  PreparedStructure out;
  task.measured.validate();
  out.data = with_held_freedoms(task.measured);
  if (out.data.mode_count() == 0)
    throw InputError({"identification", "there are no modes to start from", "0 modes", "choose some"});
  cover(task, out);
  const int fitted = set_up_mass(task, out);
  warn_of_directions(out.data, out.warnings);
  out.support = support_matrices(out.data.support, out.data.freedoms);
  out.rigid = rigid_body_basis(
      rigid_body_shapes(out.data.freedoms, out.data.node_ids, out.data.node_position), out.M);
  leave_out_unheld_modes(out);
  out.noise = noise_of(task, out, fitted);
  return out;
}

ChangeMatrices change_matrices(const StructureChange& change, const std::vector<Freedom>& freedoms) {
  Support masses;
  masses.masses = change.masses;
  ChangeMatrices matrices{support_matrices(masses, freedoms).M_s, {}};
  const auto n = static_cast<Eigen::Index>(freedoms.size());
  matrices.dK.resize(n, n);
  for (const StructureChange::Spring& spring : change.springs) {
    // k (e_a - e_b)(e_a - e_b)^T with e the rows that a joint along u would have at each end
    Support ends;
    ends.joints = {{spring.nodes[0], spring.direction}, {spring.nodes[1], spring.direction}};
    const SparseMatrix D = support_matrices(ends, freedoms).D;
    const SparseMatrix difference = D.row(0) - D.row(1);
    matrices.dK += spring.stiffness * SparseMatrix(difference.transpose() * difference);
  }
  const auto add = [n](const std::optional<SparseMatrix>& given, const char* name, SparseMatrix& sum) {
    if (!given) return;
    if (given->rows() != n || given->cols() != n)
      throw InputError({"identification",
                        fmt::format("{} freedoms need a change of {} of {} x {}", n, name, n, n),
                        fmt::format("{} x {}", given->rows(), given->cols()),
                        "give it for the freedoms of the modes in their order"});
    sum += *given;
  };
  add(change.dM, "mass", matrices.dM);
  add(change.dK, "stiffness", matrices.dK);
  return matrices;
}

}  // namespace wishbone
