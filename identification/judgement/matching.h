#pragma once

#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// Modes paired with those of a reference.
struct Matching {
  MatrixX mac;               ///< m x k
  std::vector<int> partner;  ///< m, reference mode of each; -1: none
};

/// Pairs modes (n x m) with reference modes (n x k) of ascending frequencies `omega` (k). Reference modes whose neighbours
/// differ by 0.1 % or less are one group, of which only the space R that it spans is known: any basis of it would do. A
/// mode belongs to the group that holds most of it,
///     share = |Q^T a|^2 / |a|^2,  Q an orthonormal basis of R,
/// the squared cosine of the angle between mode and space, which is the MAC for a group of one. The largest shares come
/// first, no group takes more modes than it has, none of less than `least`. Within its group a mode is held against its
/// own projection on R. Its partner there is the reference mode that it clearly resembles (share 0.9 or more); the others
/// pair in the order of frequencies.
///
/// Source of angles between spaces: A. Bjorck, G. H. Golub, Mathematics of Computation 27 (1973) 579-594.
Matching match_modes(const MatrixX& shapes, const MatrixX& reference, const VectorX& omega,
                     double least = 0.4);

}  // namespace wishbone
