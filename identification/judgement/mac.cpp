#include "identification/judgement/mac.h"

#include <algorithm>
#include <tuple>

namespace wishbone {

MatrixX modal_assurance(const MatrixX& A, const MatrixX& B) {
  const auto inverse_norms = [](const MatrixX& X) -> VectorX {
    return X.colwise().norm().unaryExpr([](double n) { return n > 0 ? 1 / n : 0.0; }).transpose();
  };
  const MatrixX cosines = inverse_norms(A).asDiagonal() * (A.transpose() * B) * inverse_norms(B).asDiagonal();
  return cosines.cwiseAbs2();
}

std::vector<int> partners(const MatrixX& mac, double least) {
  std::vector<std::tuple<double, int, int>> pairs;
  for (int j = 0; j < mac.cols(); ++j)
    for (int i = 0; i < mac.rows(); ++i)
      if (mac(i, j) >= least) pairs.emplace_back(-mac(i, j), i, j);
  std::sort(pairs.begin(), pairs.end());
  std::vector<int> partner(static_cast<std::size_t>(mac.rows()), -1);
  std::vector<bool> taken(static_cast<std::size_t>(mac.cols()), false);
  for (const auto& [value, i, j] : pairs) {
    if (partner[static_cast<std::size_t>(i)] >= 0 || taken[static_cast<std::size_t>(j)]) continue;
    partner[static_cast<std::size_t>(i)] = j;
    taken[static_cast<std::size_t>(j)] = true;
  }
  return partner;
}

}  // namespace wishbone
