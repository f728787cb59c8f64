#include "identification/free_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace wishbone {
namespace {

using Eigen::Index;

constexpr double kHeld = 1e-5;

/// Largest share of the terms of each row of K Psi that does not cancel.
VectorX resistance(const SparseMatrix& K, const MatrixX& rigid) {
  const SparseMatrix size = K.cwiseAbs();
  const MatrixX left = (K * rigid).cwiseAbs(), terms = size * rigid.cwiseAbs();
  return left.cwiseQuotient(terms.cwiseMax(std::numeric_limits<double>::min())).rowwise().maxCoeff();
}

/// Rows of node by node in x, y, z, where the matrix has x of all nodes first, then y, then z.
MatrixX axis_by_axis(const MatrixX& rows) {
  const Index n = rows.rows() / 3;
  MatrixX sorted(rows.rows(), rows.cols());
  for (Index i = 0; i < rows.rows(); ++i) sorted.row(n * (i % 3) + i / 3) = rows.row(i);
  return sorted;
}

/// The nodes that are held, the firmest first: "nodes 3, 1 and 12 more".
std::string held_nodes(const AnalyticalModel& model, const VectorX& resistance) {
  constexpr std::size_t kNamed = 8;
  const VectorX of_node = resistance.reshaped(3, resistance.size() / 3).colwise().maxCoeff();
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < model.node_ids.size(); ++i)
    if (of_node[static_cast<Index>(i)] > kHeld) held.push_back(i);
  std::stable_sort(held.begin(), held.end(), [&](std::size_t a, std::size_t b) {
    return of_node[static_cast<Index>(a)] > of_node[static_cast<Index>(b)];
  });
  std::string text = held.size() > 1 ? "nodes " : "node ";
  for (std::size_t k = 0; k < std::min(held.size(), kNamed); ++k)
    text += fmt::format("{}{}", k > 0 ? ", " : "", model.node_ids[held[k]]);
  if (held.size() > kNamed) text += fmt::format(" and {} more", held.size() - kNamed);
  return text;
}

}  // namespace

void check_is_free(const AnalyticalModel& model) {
  const MatrixX rigid = rigid_body_shapes(model.freedoms(), model.node_ids, model.node_position);
  const VectorX resists = resistance(model.K, rigid);
  if (resists.maxCoeff() <= kHeld) return;
  if (resistance(model.K, axis_by_axis(rigid)).maxCoeff() <= kHeld)
    throw InputError(
        {"model", "the rows of its matrices must run node by node: x, y, z of the first, then of the next",
         "x of all nodes first, then y, then z", "sort rows and columns of stiffness and mass by nodes"});
  throw InputError(
      {"model", "its stiffness must not resist rigid-body motion: the model is that of the free structure",
       fmt::format("{} held, by {:.2g} of the stiffness there", held_nodes(model, resists),
                   resists.maxCoeff()),
       "take the springs to the ground out of the stiffness and name them under 'support'; if nothing "
       "holds these nodes, compare the order of the rows with the table of nodes"});
}

}  // namespace wishbone
