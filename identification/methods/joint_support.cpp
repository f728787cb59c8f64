#include "identification/methods/joint_support.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/null_space.h"

namespace wishbone {
namespace {

/// Of the null-space and rank decisions on joints, relative to the largest pivot.
constexpr double kRankTolerance = 1e-9;

Eigen::ColPivHouseholderQR<MatrixX> pivoted(const MatrixX& A) {
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  qr.setThreshold(kRankTolerance);
  qr.compute(A);
  return qr;
}

void check_mode_count(Eigen::Index modes, Eigen::Index rank) {
  if (rank < modes) return;
  throw InputError({"joints",
                    fmt::format("{} independent joint directions leave no freedom to {} modes", rank, modes),
                    fmt::format("{} modes", modes), "give more modes than joint directions"});
}

/// T^T M Psi = M Psi - D^T (D Psi_0)^+T Psi_0^T M Psi: inertia forces of the modes, balanced by the joints.
MatrixX forces_of_free_structure(const Modes& unit, const SparseMatrix& M, const SparseMatrix& D,
                                 const MatrixX& rigid) {
  const int rank = held_rigid_freedoms(D, rigid);
  if (rank < rigid.cols())
    throw InputError({"joints",
                      fmt::format("the joints hold {} of {} rigid-body motions", rank, rigid.cols()),
                      fmt::format("{} joint directions", D.rows()),
                      "the stiffness against the ground says nothing about the others: hold them too"});
  const MatrixX B = M * unit.shapes;
  const Eigen::CompleteOrthogonalDecomposition<MatrixX> D_rigid(D * rigid);
  const MatrixX reactions = D_rigid.pseudoInverse().transpose() * (rigid.transpose() * B);
  return B - D.transpose() * reactions;
}

}  // namespace

Modes hold_by_joints(const MatrixX& K, const SparseMatrix& M, const std::vector<int>& held) {
  std::vector<int> left(static_cast<std::size_t>(K.rows()));
  std::iota(left.begin(), left.end(), 0);
  std::erase_if(left, [&](int i) { return std::find(held.begin(), held.end(), i) != held.end(); });
  const MatrixX M_dense(M);
  const Modes reduced = solve_eigenproblem(K(left, left), M_dense(left, left));
  Modes modes{reduced.lambda, MatrixX::Zero(K.rows(), reduced.count())};
  modes.shapes(left, Eigen::all) = reduced.shapes;
  return modes;
}

Modes hold_by_joints_multipliers(const Modes& free, const SparseMatrix& M, const SparseMatrix& D) {
  const Modes unit = mass_normalised(free, M);
  const MatrixX C_all = D * unit.shapes;
  // independent rows only, for redundant joints have no unique multipliers
  const auto qr = pivoted(C_all.transpose());
  const Eigen::Index m = unit.count(), rank = qr.rank();
  check_mode_count(m, rank);
  const MatrixX C = C_all(qr.colsPermutation().indices().head(rank), Eigen::all);

  MatrixX A = MatrixX::Zero(m + rank, m + rank);
  A.topLeftCorner(m, m) = unit.lambda.asDiagonal();
  A.topRightCorner(m, rank) = C.transpose();
  A.bottomLeftCorner(rank, m) = C;
  const Eigen::FullPivLU<MatrixX> lu(A);
  if (!lu.isInvertible())
    throw InputError({"joints", "the joints must hold every rigid-body motion of a free structure",
                      "a singular matrix", "add joints, or leave out the modes at zero frequency"});
  // With nu = 1 / lambda the multipliers drop out, (A^-1)_11 eta = nu eta, and the rank infinite roots are the
  // zeros of a symmetric matrix: the first of the ascending nu.
  const MatrixX flexibility = lu.inverse().topLeftCorner(m, m);
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen((flexibility + flexibility.transpose()) / 2);
  Modes held{eigen.eigenvalues().tail(m - rank).reverse().cwiseInverse(),
             unit.shapes * eigen.eigenvectors().rightCols(m - rank).rowwise().reverse()};
  fix_signs(held.shapes);
  return held;
}

Modes hold_by_joints_null_space(const Modes& free, const SparseMatrix& M, const SparseMatrix& D) {
  const Modes unit = mass_normalised(free, M);
  const MatrixX N = null_space(D * unit.shapes);
  check_mode_count(unit.count(), unit.count() - N.cols());
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(N.transpose() * unit.lambda.asDiagonal() * N);
  Modes held{eigen.eigenvalues(), unit.shapes * (N * eigen.eigenvectors())};
  fix_signs(held.shapes);
  return held;
}

int held_rigid_freedoms(const SparseMatrix& D, const MatrixX& rigid) {
  if (D.rows() == 0) return 0;
  return static_cast<int>(pivoted(D * rigid).rank());
}

MatrixX stiffness_without_joints(const Modes& held, const SparseMatrix& M, const SparseMatrix& D,
                                 const MatrixX& rigid) {
  const Modes unit = mass_normalised(held, M);
  const MatrixX B = forces_of_free_structure(unit, M, D, rigid);
  return B * unit.lambda.asDiagonal() * B.transpose();
}

Modes release_from_joints(const Modes& held, const SparseMatrix& M, const SparseMatrix& D,
                          const MatrixX& rigid) {
  const Modes unit = mass_normalised(held, M);
  return solve_low_rank_eigenproblem(forces_of_free_structure(unit, M, D, rigid),
                                     MatrixX(unit.lambda.asDiagonal()), M);
}

}  // namespace wishbone
