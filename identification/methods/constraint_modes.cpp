#include "identification/methods/constraint_modes.h"

#include <fmt/format.h>

#include <set>

#include "core/error.h"
#include "identification/methods/expansion.h"
#include "identification/methods/held_stiffness.h"

namespace wishbone {
namespace {

void check_freedoms(const SparseMatrix& K, const std::vector<int>& freedoms) {
  std::set<int> seen;
  for (const int freedom : freedoms) {
    if (freedom < 0 || freedom >= K.rows())
      throw InputError({"constraint modes", fmt::format("the structure has {} freedoms", K.rows()),
                        fmt::format("freedom {}", freedom + 1), "name freedoms of the structure"});
    if (!seen.insert(freedom).second)
      throw InputError({"constraint modes", "an interface freedom is named twice",
                        fmt::format("freedom {}", freedom + 1), "name each once"});
  }
}

void check_hold(const MatrixX& rigid, const std::vector<int>& freedoms) {
  const Eigen::Index free = free_rigid_motions(rigid, freedoms);
  if (free > 0)
    throw InputError({"constraint modes",
                      "the interface nodes must hold the body, for all its other nodes follow statically",
                      fmt::format("{} of {} rigid motions are held", rigid.cols() - free, rigid.cols()),
                      "name at least three nodes that do not lie on one line, or take attachment modes"});
}

}  // namespace

MatrixX constraint_modes(const SparseMatrix& K, const MatrixX& rigid, const std::vector<int>& freedoms) {
  check_freedoms(K, freedoms);
  check_hold(rigid, freedoms);
  return static_transformation(K, freedoms);
}

}  // namespace wishbone
