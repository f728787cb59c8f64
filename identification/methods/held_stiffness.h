#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "identification/methods/modes.h"

namespace wishbone {

/// As many freedoms as there are rigid motions (n x k), by pivoting so that holding them holds every one of these well:
/// a statically determinate support, which bears nothing under forces in equilibrium.
std::vector<bool> determinate_support(const MatrixX& rigid);

/// How many of the rigid motions (n x k) move none of the freedoms held, but for rounding.
Eigen::Index free_rigid_motions(const MatrixX& rigid, const std::vector<int>& held);

/// Stiffness matrix (n x n) [N/m] of a structure some of whose freedoms are held, factored once.
class HeldStiffness {
 public:
  /// @throws InputError if the structure can move without resistance although it is held
  HeldStiffness(const SparseMatrix& K, const std::vector<bool>& held);

  /// x with K x = F (n x loads) but for the held freedoms, which do not move.
  MatrixX solve(const MatrixX& F) const;

 private:
  bool is_free(Eigen::Index i) const { return place(i) >= 0; }
  int place(Eigen::Index i) const { return place_[static_cast<std::size_t>(i)]; }
  void check_pivots(const VectorX& diagonal) const;

  std::vector<int> place_;  ///< of a freedom among those that are not held; -1: held
  int free_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace wishbone
