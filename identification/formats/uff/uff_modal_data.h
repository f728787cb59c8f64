#pragma once

#include <filesystem>

#include "identification/formats/uff/uff_modes.h"
#include "identification/modal_data.h"

namespace wishbone {

/// Reads the modes and the geometry of a Universal File.
///
/// * Units: dataset 164, SI value = file value / factor; without it m and N are assumed. Mode shapes keep
///   their numbers, since a mode is known up to a factor; the modal mass psi^T M psi that belongs to them
///   becomes kg.
/// * Axes: positions are brought from definition coordinate systems (datasets 15 and 781; those of 2411 are in the
///   part's system as they stand), shapes from displacement coordinate systems (`axes`) into global axes. Of
///   cylindrical and spherical systems these are the directions of r, theta, z or r, theta, phi at each node.
///   Rotations of shapes of six values per node are dropped.
/// * Modes: normal modes (analysis type 2) and complex ones (3, 7), datasets 55 and 2414 at nodes, in
///   ascending frequency. Complex shapes become real (real_modes.h). Modes at zero frequency, below 1e-6 of
///   the highest, are left out. Damping is the viscous ratio, else half the hysteretic loss factor; modal
///   mass is NaN unless positive.
/// * Freedoms: the pairs of node and axis that move in some mode, at nodes that all modes know. A file does
///   not tell what was not measured from what stands still.
/// * Lines: trace lines (82) and the edges of elements (2412).
///
/// `provenance` says what was assumed and left out. Throws InputError as read_uff does, and when the file has
/// no modes or no positions of their nodes, saying what it does have.
ModalData read_uff_modal_data(const std::filesystem::path& path,
                              UffShapeAxes axes = UffShapeAxes::kByDataset);

/// The same of a file that was read; `path` is its name.
ModalData uff_modal_data(const UffFile& file, const std::filesystem::path& path,
                         UffShapeAxes axes = UffShapeAxes::kByDataset);

/// Writes modes in SI units and global axes: datasets 151, 164, 2411, 82 and one 55 for each mode.
///
/// What the format cannot hold is lost: shapes, frequencies, damping and modal mass keep 6 digits; freedoms
/// that are not listed become zero; nodal masses, support and provenance are not written. Throws InputError
/// when `data` is not valid, NumericsError when the file cannot be written.
void write_uff_modal_data(const std::filesystem::path& path, const ModalData& data);

}  // namespace wishbone
