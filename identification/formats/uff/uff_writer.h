#pragma once

#include <filesystem>

#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// Writes a Universal File in the formats of the standard, so that other programs can read it: datasets 151,
/// 164, 18, 2411, 781 or 15 (as `node_dataset` says), 2412, 82, 55 or 2414 (what each shape says), 58 or 58b (what each
/// function says). `unused` and `repeated_nodes` are not written.
///
/// The standard's formats round: nodes in 2411 keep 17 digits and binary functions all bits, but nodal shapes and
/// frequencies (6E13.5), coordinate systems, and functions in single precision as text keep 6 digits,
/// functions in double precision as text 13. Dataset 2414 is no more precise than 55.
///
/// Throws InputError when sizes do not fit together, a text has a line break, or nodes of definition systems are to
/// become dataset 2411; NumericsError when the file
/// cannot be written (folder missing, disk full).
void write_uff(const std::filesystem::path& path, const UffFile& file);

}  // namespace wishbone
