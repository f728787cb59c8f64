#include "identification/methods/nnls.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "core/error.h"

namespace wishbone {
namespace {

using Set = std::vector<Eigen::Index>;

/// Least squares over the columns of the passive set.
VectorX passive_solution(const MatrixX& A, const VectorX& b, const Set& passive) {
  return A(Eigen::all, passive).colPivHouseholderQr().solve(b);
}

/// Moves x towards z as far as x >= 0 allows and drops what became zero from the passive set.
void step_back(const VectorX& z, VectorX& x, Set& passive) {
  double alpha = 1;
  for (std::size_t k = 0; k < passive.size(); ++k)
    if (const double x_k = x[passive[k]], z_k = z[static_cast<Eigen::Index>(k)]; z_k <= 0)
      alpha = std::min(alpha, x_k / (x_k - z_k));
  for (std::size_t k = 0; k < passive.size(); ++k)
    x[passive[k]] += alpha * (z[static_cast<Eigen::Index>(k)] - x[passive[k]]);
  const double zero = 1e-14 * x.cwiseAbs().maxCoeff();
  std::erase_if(passive, [&](Eigen::Index i) {
    if (x[i] > zero) return false;
    x[i] = 0;
    return true;
  });
}

}  // namespace

VectorX nonnegative_least_squares(const MatrixX& A, const VectorX& b) {
  const Eigen::Index n = A.cols();
  VectorX x = VectorX::Zero(n);
  Set passive;
  const double tolerance = 1e-13 * (A.transpose() * b).cwiseAbs().maxCoeff();
  for (Eigen::Index exchange = 0; exchange <= 3 * n; ++exchange) {
    // w = A^T (b - A x) > 0 on an active component: letting it grow lowers the residual
    VectorX w = A.transpose() * (b - A * x);
    for (const Eigen::Index i : passive) w[i] = 0;
    Eigen::Index best = 0;
    if (static_cast<Eigen::Index>(passive.size()) == n || w.maxCoeff(&best) <= tolerance) return x;
    passive.push_back(best);
    VectorX z = passive_solution(A, b, passive);
    while (z.size() > 0 && z.minCoeff() <= 0) {
      step_back(z, x, passive);
      if (passive.empty()) break;
      z = passive_solution(A, b, passive);
    }
    x.setZero();
    for (std::size_t k = 0; k < passive.size(); ++k) x[passive[k]] = z[static_cast<Eigen::Index>(k)];
  }
  throw NumericsError({"non-negative least squares", "the active sets do not settle",
                       fmt::format("{} exchanges", 3 * n), "look for columns that are nearly dependent"});
}

}  // namespace wishbone
