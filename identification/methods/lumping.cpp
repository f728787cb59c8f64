#include "identification/methods/lumping.h"

#include <fmt/format.h>

#include "core/error.h"

namespace wishbone {
namespace {

using Eigen::Index;

void check_size(const SparseMatrix& M) {
  if (M.rows() != M.cols() || M.rows() % 3 != 0)
    throw InputError({"mass matrix", "it must have three rows and columns for every node",
                      fmt::format("{} x {}", M.rows(), M.cols()), "list x, y, z of each node"});
}

/// sum_j M_ij over the freedoms j of the direction of i (3 x n).
Matrix3X row_sums(const SparseMatrix& M) {
  Matrix3X sums = Matrix3X::Zero(3, M.rows() / 3);
  for (Index j = 0; j < M.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(M, j); it; ++it)
      if (it.row() % 3 == j % 3) sums(j % 3, it.row() / 3) += it.value();
  return sums;
}

}  // namespace

std::optional<VectorX> nodal_masses(const SparseMatrix& M) {
  check_size(M);
  const VectorX diagonal = M.diagonal();
  const double tolerance = 1e-9 * diagonal.cwiseAbs().maxCoeff();
  for (Index j = 0; j < M.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(M, j); it; ++it)
      if (it.row() != j && !(std::abs(it.value()) <= tolerance)) return std::nullopt;
  const auto by_node = diagonal.reshaped(3, diagonal.size() / 3);
  for (int axis = 1; axis < 3; ++axis)
    if (!((by_node.row(axis) - by_node.row(0)).cwiseAbs().maxCoeff() <= tolerance)) return std::nullopt;
  return by_node.row(0).transpose();
}

VectorX lumped_masses(const SparseMatrix& M, Lumping lumping) {
  check_size(M);
  Matrix3X mass = row_sums(M);
  if (lumping == Lumping::diagonal) {
    const VectorX diagonal = M.diagonal();
    const Matrix3X by_node = diagonal.reshaped(3, diagonal.size() / 3);
    const Vector3 factor = mass.rowwise().sum().cwiseQuotient(by_node.rowwise().sum());
    mass = factor.asDiagonal() * by_node;
  }
  for (Index i = 0; i < mass.cols(); ++i) {
    if (!(mass.col(i).minCoeff() > 0))
      throw InputError({"mass matrix",
                        fmt::format("the lumped mass of node number {} must be positive", i + 1),
                        fmt::format("{:g} kg", mass.col(i).minCoeff()),
                        lumping == Lumping::row_sum ? "lump by 'diagonal', which keeps the sign"
                                                    : "condense massless nodes out of the model first"});
    if (!(mass.col(i).maxCoeff() - mass.col(i).minCoeff() <= 1e-6 * mass.col(i).maxCoeff()))
      throw InputError(
          {"mass matrix",
           fmt::format("the lumped mass of node number {} must be the same in x, y and z", i + 1),
           fmt::format("{:g}, {:g}, {:g} kg", mass(0, i), mass(1, i), mass(2, i)),
           "leave out what moves with a node in one direction only"});
  }
  return mass.colwise().mean();
}

}  // namespace wishbone
