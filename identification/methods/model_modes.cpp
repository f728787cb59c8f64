#include "identification/methods/model_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/null_space.h"
#include "identification/methods/lowest_modes.h"

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

}  // namespace

Modes model_modes(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                  std::optional<Eigen::Index> count) {
  const SparseMatrix K_t = K + support.K_s, M_t = M + support.M_s;
  if (support.D.rows() == 0) return solve_sparse(K_t, M_t, count);
  const SparseMatrix N = sparse_null_space(support.D);
  const SparseMatrix N_T = N.transpose();
  Modes modes = solve_sparse(N_T * K_t * N, N_T * M_t * N, count);
  modes.shapes = N * modes.shapes;
  fix_signs(modes.shapes);
  return modes;
}

}  // namespace wishbone
