#include "identification/methods/combined_modes.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <numeric>

#include "core/error.h"

namespace wishbone {
namespace {

using Eigen::Index;

constexpr double kAddsNothing = 1e-12;  // of the strain energy of the shapes
constexpr double kOnlyRigid = 1e-20;    // of the modal mass of a shape, when it is elastic
constexpr double kCoupled = 1e-6;       // cosine between a kept mode and the others in the metric of K

/// || x ||^2 of every column in the metric of A.
VectorX squared_norms(const MatrixX& X, const SparseMatrix& A) {
  return X.cwiseProduct(A * X).colwise().sum();
}

MatrixX columns(const MatrixX& X, const std::vector<Index>& chosen) {
  return X(Eigen::all, chosen);
}

/// E <- E L^-T with E^T A E = L L^T: orthonormal in the metric of A, a column being changed by those before it only.
void orthonormalise(MatrixX& E, const SparseMatrix& A) {
  const Eigen::LLT<MatrixX> L(E.transpose() * (A * E));
  E = L.matrixL().solve(E.transpose()).transpose();
}

/// What static shapes add to rigid and kept motion: a basis E, E^T K E = 1, group by group.
class Remainder {
 public:
  Remainder(const SparseMatrix& K, const SparseMatrix& M, const MatrixX& rigid, const Modes& kept)
      : K_(K), M_(M), E_(K.rows(), 0) {
    known_.resize(K.rows(), rigid.cols() + kept.count());
    known_ << rigid, kept.shapes;
    M_known_ = M * known_;
    rigid_count_ = rigid.cols();
  }

  const MatrixX& basis() const { return E_; }

  /// Appends what the shapes add.
  void add(MatrixX X) {
    if (X.cols() == 0) return;
    X = with_unit_energy(std::move(X));
    if (X.cols() == 0) return;
    project(X);
    project(X);
    const Eigen::SelfAdjointEigenSolver<MatrixX> energy(X.transpose() * (K_ * X));
    const Index added = (energy.eigenvalues().array() > kAddsNothing).count();
    if (added == 0) return;
    X *= energy.eigenvectors().rightCols(added).rowwise().reverse();
    X *= energy.eigenvalues().tail(added).reverse().cwiseSqrt().cwiseInverse().asDiagonal();
    for (int pass = 0; pass < 2; ++pass) {  // what is left may have been small
      project(X);
      orthonormalise(X, K_);
    }
    E_.conservativeResize(Eigen::NoChange, E_.cols() + added);
    E_.rightCols(added) = X;
  }

  /// X <- (1 - Psi_0 Psi_0^T M - Psi Psi^T M) X
  void take_out_known(MatrixX& X) const { X -= known_ * (M_known_.transpose() * X); }

 private:
  /// The elastic shapes among them, x^T K x = 1, without rigid motion.
  MatrixX with_unit_energy(MatrixX X) const {
    const VectorX mass = squared_norms(X, M_);
    for (int pass = 0; pass < 2; ++pass)
      X -= known_.leftCols(rigid_count_) * (M_known_.leftCols(rigid_count_).transpose() * X);
    const VectorX elastic_mass = squared_norms(X, M_);
    std::vector<Index> elastic;
    for (Index j = 0; j < X.cols(); ++j)
      if (elastic_mass[j] > kOnlyRigid * mass[j]) elastic.push_back(j);
    X = columns(X, elastic);
    return X * squared_norms(X, K_).cwiseSqrt().cwiseInverse().asDiagonal();
  }

  void project(MatrixX& X) const {
    take_out_known(X);
    X -= E_ * (E_.transpose() * (K_ * X));
  }

  const SparseMatrix &K_, &M_;
  MatrixX known_, M_known_;  ///< n x (k + m), rigid and kept modes, and M times these
  Index rigid_count_ = 0;
  MatrixX E_;  ///< n x e
};

/// (E^T M E) y = (1 / lambda) y, psi = E y sqrt(lambda): ascending. `Y` becomes the y of each, y^T y = 1.
Modes flexibility_ritz(const SparseMatrix& K, const SparseMatrix& M, const Remainder& remainder, MatrixX& Y) {
  const MatrixX& E = remainder.basis();
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(E.transpose() * (M * E));
  Y = eigen.eigenvectors().rowwise().reverse();
  Modes modes;
  modes.shapes = E * Y * eigen.eigenvalues().reverse().cwiseSqrt().cwiseInverse().asDiagonal();
  remainder.take_out_known(modes.shapes);
  orthonormalise(modes.shapes, M);
  fix_signs(modes.shapes);
  modes.lambda = squared_norms(modes.shapes, K);
  return modes;
}

void check_uncoupled(const SparseMatrix& K, const Modes& kept, const MatrixX& E) {
  if (kept.count() == 0) return;
  const MatrixX cosine =
      kept.lambda.cwiseSqrt().cwiseInverse().asDiagonal() * (kept.shapes.transpose() * (K * E));
  if (const double worst = cosine.cwiseAbs().maxCoeff(); !(worst <= kCoupled))
    throw InputError({"modes", "the kept modes must be modes of this stiffness and mass",
                      fmt::format("coupling {:.2g} with static shapes", worst),
                      "compute the modes from the same model as the static shapes"});
}

/// Both sets, ascending.
CombinedModes merged(const Modes& kept, const Modes& added, const std::vector<ModeKind>& added_kinds) {
  const Index count = kept.count() + added.count();
  VectorX lambda(count);
  lambda << kept.lambda, added.lambda;
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return lambda[a] < lambda[b]; });

  CombinedModes all{{VectorX(count), MatrixX(added.shapes.rows(), count)}, {}, 0};
  for (Index j = 0; j < count; ++j) {
    const Index from = order[static_cast<std::size_t>(j)];
    const bool is_kept = from < kept.count();
    all.modes.lambda[j] = lambda[from];
    all.modes.shapes.col(j) = is_kept ? kept.shapes.col(from) : added.shapes.col(from - kept.count());
    all.kinds.push_back(is_kept ? ModeKind::normal
                                : added_kinds[static_cast<std::size_t>(from - kept.count())]);
  }
  return all;
}

}  // namespace

const char* to_string(ModeKind kind) {
  switch (kind) {
    case ModeKind::normal:
      return "normal";
    case ModeKind::attachment:
      return "attachment";
    case ModeKind::constraint:
      return "constraint";
    case ModeKind::fixed_interface:
      break;
  }
  return "fixed-interface";
}

ModeKind largest_share(const VectorX& energy, const std::vector<ModeKind>& kinds) {
  std::map<ModeKind, double> sum;
  for (Index i = 0; i < energy.size(); ++i) sum[kinds[static_cast<std::size_t>(i)]] += energy[i];
  return std::max_element(sum.begin(), sum.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

CombinedModes combined_modes(const SparseMatrix& K, const SparseMatrix& M, const MatrixX& rigid,
                             const Modes& kept, const MatrixX& attachment, const MatrixX& constraint,
                             const MatrixX& fixed_interface) {
  Remainder remainder(K, M, rigid, kept);
  std::vector<ModeKind> group;  // of each column of E
  Index given = 0;
  for (const auto& [kind, shapes] : {std::pair(ModeKind::attachment, &attachment),
                                     {ModeKind::constraint, &constraint},
                                     {ModeKind::fixed_interface, &fixed_interface}}) {
    remainder.add(*shapes);
    group.resize(static_cast<std::size_t>(remainder.basis().cols()), kind);
    given += shapes->cols();
  }
  const Index added = remainder.basis().cols();
  if (added == 0)
    return {kept, std::vector<ModeKind>(static_cast<std::size_t>(kept.count()), ModeKind::normal), given};

  check_uncoupled(K, kept, remainder.basis());
  MatrixX Y;
  const Modes modes = flexibility_ritz(K, M, remainder, Y);
  std::vector<ModeKind> kinds;
  for (Index j = 0; j < added; ++j)  // strain energy y^T E^T K E y = y^T y
    kinds.push_back(largest_share(Y.col(j).cwiseAbs2(), group));
  CombinedModes all = merged(kept, modes, kinds);
  all.left_out = given - added;
  return all;
}

}  // namespace wishbone
