#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace wishbone {

/// Why something is not to be read, and what to do about it.
struct InputFault {
  std::string what, remedy;
};

/// Only regular files on a disk are read, for they alone have an end: a name that is missing, a folder, a pipe, a device or a file
/// that the kernel makes up (/proc/kmsg) would fail later, or keep the program waiting for ever. Nothing when it may be opened.
std::optional<InputFault> input_fault(const std::filesystem::path& path);

}  // namespace wishbone
