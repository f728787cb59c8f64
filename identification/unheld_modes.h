#pragma once

#include "identification/prepared_structure.h"

namespace wishbone {

/// Leaves out the measured modes that are mostly rigid motion which the support does not resist. A structure has no such
/// mode, but programs list them, at the frequency that rounding gives them, and tests do on a support that nobody named.
/// Exact elastic modes have no share of that motion and exact rigid ones nothing else, whatever the digits of the file: a
/// half of the modal mass lies in the widest gap.
///
/// What holds the structure at f moves an elastic frequency f_e by the share (f / f_e)^2 / 2 or so. Where this is more
/// than rounding the frequencies that stay are those on a support, which is told.
/// Throws InputError if no other mode was measured.
void leave_out_unheld_modes(PreparedStructure& structure);

}  // namespace wishbone
