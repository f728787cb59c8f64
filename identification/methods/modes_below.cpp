#include "identification/methods/modes_below.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>

#include "core/error.h"

namespace wishbone {

Eigen::Index modes_below(const SparseMatrix& K, const SparseMatrix& M, double lambda) {
  // a pivot vanishes where the limit is an eigenvalue of a leading part: then another one next to it
  for (const double nudge : {0.0, 1e-12, -1e-12, 1e-11, -1e-11, 1e-10, -1e-10}) {
    const Eigen::SimplicialLDLT<SparseMatrix> factor(SparseMatrix(K - (lambda * (1 + nudge)) * M));
    if (factor.info() == Eigen::Success && factor.vectorD().allFinite())
      return (factor.vectorD().array() < 0).count();
  }
  throw NumericsError({"modes", "the modes below a limit cannot be counted",
                       fmt::format("{:g} rad2/s2", lambda), "move the limit a little"});
}

}  // namespace wishbone
