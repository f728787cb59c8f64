#include "identification/methods/attachment_modes.h"

#include <fmt/format.h>

#include "core/error.h"
#include "identification/methods/held_stiffness.h"

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

}  // namespace

MatrixX attachment_modes(const SparseMatrix& K, const SparseMatrix& M, const MatrixX& rigid,
                         const std::vector<int>& freedoms) {
  check_input(K, rigid, freedoms);
  const auto count = static_cast<Eigen::Index>(freedoms.size());
  const MatrixX M_rigid = M * rigid;
  MatrixX F = -M_rigid * rigid(freedoms, Eigen::all).transpose();  // f_e
  for (Eigen::Index a = 0; a < count; ++a) F(freedoms[static_cast<std::size_t>(a)], a) += 1;

  const HeldStiffness held(K, determinate_support(rigid));
  MatrixX X = held.solve(F);
  X += held.solve(F - K * X);  // one refinement: the support may be far softer than the elements
  X -= rigid * (M_rigid.transpose() * X);
  return X;
}

}  // namespace wishbone
