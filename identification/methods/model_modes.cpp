#include "identification/methods/model_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/null_space.h"
#include "identification/methods/lowest_modes.h"
#include "identification/methods/modes_below.h"

namespace wishbone {
namespace {

/// Sparse orthonormal basis N of the null space of D (n x (n - rank)): joints touch few freedoms, over which it is
/// dense; the others keep their own coordinates.
SparseMatrix sparse_null_space(const SparseMatrix& D) {
  std::vector<int> touched, untouched;
  for (int j = 0; j < D.cols(); ++j) (D.col(j).nonZeros() > 0 ? touched : untouched).push_back(j);
  const MatrixX basis = null_space(MatrixX(D)(Eigen::all, touched));

  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < untouched.size(); ++k)
    entries.emplace_back(untouched[k], static_cast<int>(k), 1.0);
  const int first = static_cast<int>(untouched.size());
  for (int j = 0; j < basis.cols(); ++j)
    for (int i = 0; i < basis.rows(); ++i)
      entries.emplace_back(touched[static_cast<std::size_t>(i)], first + j, basis(i, j));
  SparseMatrix N(D.cols(), first + basis.cols());
  N.setFromTriplets(entries.begin(), entries.end());
  return N;
}

/// Few modes of a large model by Lanczos iteration, otherwise all of them at once.
Modes solve_sparse(const SparseMatrix& K, const SparseMatrix& M, std::optional<Eigen::Index> count) {
  constexpr Eigen::Index kSmall = 600;
  if (count && *count < K.rows() / 4 && K.rows() > kSmall)
    return lowest_modes(K, M, static_cast<int>(*count));
  if (K.rows() > kMostDenseFreedoms)
    throw InputError({"model", "it is too large for all of its modes",
                      fmt::format("{} of at most {} freedoms", K.rows(), kMostDenseFreedoms),
                      "ask for fewer modes than a quarter of the freedoms"});
  const Modes modes = solve_eigenproblem(MatrixX(K), MatrixX(M));
  return count ? modes.lowest(std::min(*count, modes.count())) : modes;
}

/// The model on its support over the motions x = N y that the joints leave.
struct Supported {
  SparseMatrix N;  ///< 0 x 0 without joints: y = x
  SparseMatrix K, M;

  Supported(const SparseMatrix& K_free, const SparseMatrix& M_free, const SupportMatrices& support)
      : K(K_free + support.K_s), M(M_free + support.M_s) {
    if (support.D.rows() == 0) return;
    N = sparse_null_space(support.D);
    const SparseMatrix N_T = N.transpose();
    K = SparseMatrix(N_T * K * N);
    M = SparseMatrix(N_T * M * N);
  }
};

}  // namespace

Modes model_modes(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                  std::optional<Eigen::Index> count) {
  const Supported held(K, M, support);
  Modes modes = solve_sparse(held.K, held.M, count);
  if (held.N.rows() == 0) return modes;
  modes.shapes = held.N * modes.shapes;
  fix_signs(modes.shapes);
  return modes;
}

Eigen::Index model_modes_below(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                               double lambda) {
  const Supported held(K, M, support);
  return modes_below(held.K, held.M, lambda);
}

}  // namespace wishbone
