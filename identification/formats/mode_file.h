#pragma once

#include <string>

#include "core/hdf5.h"
#include "core/hdf5_reader.h"
#include "identification/modal_data.h"

namespace wishbone {

/// A mode file is HDF5, complete and self-describing; docs/modal_files.md has its layout. What is read is what
/// was written, to the last bit, and equal data give equal bytes.

/// Writes the file; it has its name once it is whole. Throws InputError for data that are not valid,
/// NumericsError when writing fails.
void write_mode_file(const std::string& path, const ModalData& data);

/// Writes the same datasets and attributes into a group, mostly the root of a file to which others add what
/// belongs to the modes.
void write_mode_file(hdf5::Group& group, const ModalData& data);

/// Throws InputError naming file and dataset for a file that is not a mode file, a dataset that is missing, has
/// the wrong shape, or holds something else than node ids where these are due, and for data that are not valid.
ModalData read_mode_file(const std::string& path);

/// Reads from a group what write_mode_file put there.
ModalData read_mode_file(const hdf5::GroupReader& group);

/// True when the group has the attributes of one that write_mode_file wrote into.
bool is_mode_file(const hdf5::GroupReader& group);

/// "4 springs, 1 joint, 2 masses", or "free".
std::string describe_support(const Support& support);

}  // namespace wishbone
