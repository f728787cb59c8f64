#include "identification/methods/held_stiffness.h"

#include <fmt/format.h>

#include <Eigen/QR>

#include "core/error.h"

namespace wishbone {

std::vector<bool> determinate_support(const MatrixX& rigid) {
  std::vector<bool> held(static_cast<std::size_t>(rigid.rows()), false);
  if (rigid.cols() == 0) return held;
  const Eigen::ColPivHouseholderQR<MatrixX> qr(rigid.transpose());
  for (Eigen::Index i = 0; i < rigid.cols(); ++i)
    held[static_cast<std::size_t>(qr.colsPermutation().indices()[i])] = true;
  return held;
}

Eigen::Index free_rigid_motions(const MatrixX& rigid, const std::vector<int>& held) {
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  qr.setThreshold(1e-6);
  qr.compute(rigid(held, Eigen::all));
  return rigid.cols() - qr.rank();
}

HeldStiffness::HeldStiffness(const SparseMatrix& K, const std::vector<bool>& held) : place_(held.size(), -1) {
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) place_[i] = free_++;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(K.nonZeros()));
  for (Eigen::Index j = 0; j < K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(K, j); it; ++it)
      if (is_free(it.row()) && is_free(j)) entries.emplace_back(place(it.row()), place(j), it.value());
  if (free_ == 0) return;
  SparseMatrix K_free(free_, free_);
  K_free.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(K_free);
  check_pivots(VectorX(K_free.diagonal()));
}

MatrixX HeldStiffness::solve(const MatrixX& F) const {
  if (free_ == 0) return MatrixX::Zero(F.rows(), F.cols());
  MatrixX F_free(free_, F.cols());
  for (Eigen::Index i = 0; i < F.rows(); ++i)
    if (is_free(i)) F_free.row(place(i)) = F.row(i);
  const MatrixX x_free = factor_.solve(F_free);
  MatrixX x = MatrixX::Zero(F.rows(), F.cols());
  for (Eigen::Index i = 0; i < F.rows(); ++i)
    if (is_free(i)) x.row(i) = x_free.row(place(i));
  return x;
}

void HeldStiffness::check_pivots(const VectorX& diagonal) const {
  constexpr double kNoStiffness = 1e-12;  // of the largest stiffness of a freedom
  const VectorX& d = factor_.vectorD();
  if (factor_.info() == Eigen::Success && d.minCoeff() > kNoStiffness * diagonal.maxCoeff()) return;
  throw InputError({"static deflection", "the stiffness must resist every motion that is not rigid",
                    d.size() == 0 ? "" : fmt::format("smallest pivot {:.3g} N/m", d.minCoeff()),
                    "look for loose parts or hinges between elements"});
}

}  // namespace wishbone
