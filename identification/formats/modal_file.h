#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// Modal data in whatever file the extension of its name says, in any case of its letters:
///
///     .h5, .hdf5    mode file (mode_file.h): keeps everything to the last bit
///     .unv, .uff    Universal File (uff_modal_data.h): written with 6 digits
///     .csv          NAME.csv stands for NAME_nodes.csv, NAME_frequencies.csv and NAME_shapes.csv (csv_modal_data.h)
///
/// All throw InputError for any other extension.

/// Throws InputError as the reader of the format does.
ModalData read_modal_data(const std::filesystem::path& path);

/// Throws InputError for data that are not valid, NumericsError when writing fails.
void write_modal_data(const std::filesystem::path& path, const ModalData& data);

/// The files that bear the modal data of this name.
std::vector<std::filesystem::path> modal_data_files(const std::filesystem::path& path);

/// What `data` has and the format of `path` has no place for, in words: "support (4 springs)", "lines", ...
std::vector<std::string> lost_in_modal_data(const std::filesystem::path& path, const ModalData& data);

enum class ModalFormat { kModeFile, kUniversalFile, kCsvTables };
/// The format of that name; nothing when the extension is none of the above.
std::optional<ModalFormat> modal_format(const std::filesystem::path& path);

}  // namespace wishbone
