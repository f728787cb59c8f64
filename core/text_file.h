#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/source.h"

namespace wishbone {

/// Reads a whole UTF-8 text file of at most `max_bytes`. Throws InputError for what is missing, no regular file
/// (a directory, a pipe, a device), unreadable, too large, empty, binary or not UTF-8; `asked_from` (may be empty) is where the file was
/// named.
std::string read_text_file(const std::filesystem::path& path, std::size_t max_bytes,
                           const Source& asked_from);

}  // namespace wishbone
