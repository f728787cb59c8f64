#include "identification/methods/model_modes.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>

#include "core/error.h"

namespace wishbone {

Modes model_modes(const SparseMatrix& K, const SparseMatrix& M, const SupportMatrices& support,
                  std::optional<Eigen::Index> count) {
  if (K.rows() > kMostDenseFreedoms)
    throw InputError({"model", "it is too large for a dense eigenproblem",
                      fmt::format("{} of at most {} freedoms", K.rows(), kMostDenseFreedoms),
                      "compute its lowest modes elsewhere and read them from a file"});
  const MatrixX K_t(K + support.K_s), M_t(M + support.M_s);
  Modes modes;
  if (support.D.rows() == 0) {
    modes = solve_eigenproblem(K_t, M_t);
  } else {
    const Eigen::ColPivHouseholderQR<MatrixX> qr(MatrixX(support.D.transpose()));
    MatrixX N = MatrixX::Zero(K.rows(), K.rows() - qr.rank());
    N.bottomRows(N.cols()).setIdentity();
    N.applyOnTheLeft(qr.householderQ());
    modes = solve_eigenproblem(N.transpose() * K_t * N, N.transpose() * M_t * N);
    modes.shapes = N * modes.shapes;
    fix_signs(modes.shapes);
  }
  return count ? modes.lowest(std::min(*count, modes.count())) : modes;
}

}  // namespace wishbone
