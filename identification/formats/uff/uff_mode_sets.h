#pragma once

#include <string>
#include <vector>

#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// One mode, put together from the datasets that hold it.
struct UffModeSet {
  double omega = 0;  ///< [rad/s]
  double damping_ratio = 0;
  double modal_mass = 0;               ///< as in the file, NaN where nothing is known
  std::vector<const UffShape*> parts;  ///< of different nodes
  bool is_complex = false;             ///< a shape has imaginary parts
};

/// Undamped angular frequency and damping ratio of a nodal result: of complex modes |s| and -Re s / |s|, of normal ones
/// those stated, or sqrt(lambda) where only the eigenvalue is; of others the frequency stated, which may be zero.
struct UffOscillation {
  double omega = 0;  ///< [rad/s]
  double damping_ratio = 0;
};
UffOscillation uff_oscillation(const UffShape& shape);

/// The oscillating modes of a file in ascending frequency, and what was left out on the way (appended to
/// `provenance`): shapes that are no modes, velocities where there are displacements, datasets given twice,
/// the conjugates of complex modes, modes of zero frequency. Datasets of equal mode, load case and frequency
/// at different nodes are parts of one mode; at the same nodes with other values they are different modes.
std::vector<UffModeSet> uff_mode_sets(const UffFile& file, std::vector<std::string>& provenance);

}  // namespace wishbone
