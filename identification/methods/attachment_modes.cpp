#include "identification/methods/attachment_modes.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <cmath>

#include "core/error.h"

namespace wishbone {
namespace {

void check_input(const SparseMatrix& K, const MatrixX& rigid, const std::vector<int>& freedoms) {
  for (const int freedom : freedoms)
    if (freedom < 0 || freedom >= K.rows())
      throw InputError({"attachment modes", fmt::format("the structure has {} freedoms", K.rows()),
                        fmt::format("freedom {}", freedom + 1), "name freedoms of the structure"});
  if (rigid.cols() == 0) return;
  const double resistance = (K * rigid).norm() / (K.norm() * rigid.norm());
  if (!(resistance <= 1e-8))
    throw InputError({"attachment modes", "the stiffness must not resist rigid-body motion of a free body",
                      fmt::format("relative resistance {:.3g}", resistance),
                      "remove supports and springs to ground from it"});
}

/// As many freedoms as there are rigid motions, by pivoting so that holding them holds every one of these well.
std::vector<bool> held_freedoms(const MatrixX& rigid) {
  std::vector<bool> held(static_cast<std::size_t>(rigid.rows()), false);
  if (rigid.cols() == 0) return held;
  const Eigen::ColPivHouseholderQR<MatrixX> qr(rigid.transpose());
  for (Eigen::Index i = 0; i < rigid.cols(); ++i)
    held[static_cast<std::size_t>(qr.colsPermutation().indices()[i])] = true;
  return held;
}

/// K on a statically determinate support.
class HeldStiffness {
 public:
  HeldStiffness(const SparseMatrix& K, const std::vector<bool>& held) : place_(held.size(), -1) {
    for (std::size_t i = 0; i < held.size(); ++i)
      if (!held[i]) place_[i] = free_++;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(K.nonZeros()));
    for (Eigen::Index j = 0; j < K.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(K, j); it; ++it)
        if (is_free(it.row()) && is_free(j)) entries.emplace_back(place(it.row()), place(j), it.value());
    SparseMatrix K_free(free_, free_);
    K_free.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(K_free);
    check_pivots(VectorX(K_free.diagonal()));
  }

  /// x with K x = F but for the held freedoms, which do not move.
  MatrixX solve(const MatrixX& F) const {
    MatrixX F_free(free_, F.cols());
    for (Eigen::Index i = 0; i < F.rows(); ++i)
      if (is_free(i)) F_free.row(place(i)) = F.row(i);
    const MatrixX x_free = factor_.solve(F_free);
    MatrixX x = MatrixX::Zero(F.rows(), F.cols());
    for (Eigen::Index i = 0; i < F.rows(); ++i)
      if (is_free(i)) x.row(i) = x_free.row(place(i));
    return x;
  }

 private:
  bool is_free(Eigen::Index i) const { return place(i) >= 0; }
  int place(Eigen::Index i) const { return place_[static_cast<std::size_t>(i)]; }

  void check_pivots(const VectorX& diagonal) const {
    constexpr double kNoStiffness = 1e-12;  // of the largest stiffness of a freedom
    const VectorX& d = factor_.vectorD();
    if (factor_.info() == Eigen::Success && d.minCoeff() > kNoStiffness * diagonal.maxCoeff()) return;
    throw InputError({"attachment modes", "the stiffness must resist every motion that is not rigid",
                      d.size() == 0 ? "" : fmt::format("smallest pivot {:.3g} N/m", d.minCoeff()),
                      "look for loose parts or hinges between elements"});
  }

  std::vector<int> place_;  ///< of a freedom among those that are not held; -1: held
  int free_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace

MatrixX attachment_modes(const SparseMatrix& K, const SparseMatrix& M, const MatrixX& rigid,
                         const std::vector<int>& freedoms) {
  check_input(K, rigid, freedoms);
  const auto count = static_cast<Eigen::Index>(freedoms.size());
  const MatrixX M_rigid = M * rigid;
  MatrixX F = -M_rigid * rigid(freedoms, Eigen::all).transpose();  // f_e
  for (Eigen::Index a = 0; a < count; ++a) F(freedoms[static_cast<std::size_t>(a)], a) += 1;

  const HeldStiffness held(K, held_freedoms(rigid));
  MatrixX X = held.solve(F);
  X += held.solve(F - K * X);  // one refinement: the support may be far softer than the elements
  X -= rigid * (M_rigid.transpose() * X);
  return X;
}

}  // namespace wishbone
