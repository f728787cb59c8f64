#pragma once

#include "identification/methods/design_change.h"

namespace wishbone {

/// Modes of a free structure after it is put on springs K_s, from its free-free modes, the rigid-body modes
/// among them: K + K_s for a complete set [3.4, 3.5], K* + K_s* for an incomplete one [3.7-3.9].
Modes hold_by_springs(Space space, const Modes& free, const SparseMatrix& M, const SparseMatrix& K_s);

/// Free-free modes of a structure from its modes on springs K_s that carry masses M_s: with M = M_t - M_s [4.1],
/// K = K_t - K_s for a complete set [4.2], K_t* - K_s* for an incomplete one [4.3-4.5], or the same in modal
/// space [4.6-4.14]. M_t, the mass with that of the support, is what the given modes are orthogonal in. The
/// rigid-body modes are among those returned, as far as the set can express them: RigidFreeModes
/// (released_modes.h) puts the exact ones in their place.
Modes release_from_springs(Space space, const Modes& supported, const SparseMatrix& M_t,
                           const SparseMatrix& M_s, const SparseMatrix& K_s);

}  // namespace wishbone
