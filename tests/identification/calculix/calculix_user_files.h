#pragma once

#include <filesystem>

#include "identification/calculix/calculix_structure.h"

namespace wishbone {

/// Writes a structure as its analyst would hand it over, into a folder that exists:
///
///     modes.h5, modes.unv, modes_*.csv   modes on the support: mode file, Universal File, tables
///     mass.mtx                           M
///     free.h5                            elastic free-free modes to compare with
///     identification.yaml                for `wishbone identify`: modes.h5 released from the support
///
/// A Universal File does not tell freedoms that stand still from freedoms that were not measured: use one of
/// the others for modes on joints.
void write_user_files(const CalculixStructure& structure, const std::filesystem::path& folder);

}  // namespace wishbone
