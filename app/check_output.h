#pragma once

#include <string>
#include <vector>

namespace wishbone {

/// Refuses, before anything is computed, a file to be written that could not be written or would destroy an input.
/// @throws InputError when `path` is empty, its folder is missing or read-only, something other than a writable file has the
///   name (a folder, a device), or the name (or the one that results bear while they are written, PATH.partial) is that of
///   one of `inputs`, by whatever path; inputs that do not exist are passed over
void check_output(const std::string& path, const std::vector<std::string>& inputs);

/// The same for modal data, whose name may stand for several files.
void check_modal_output(const std::string& path, const std::vector<std::string>& inputs);

/// The same for a folder of files; it need not exist, but the one that it is in must.
void check_output_folder(const std::string& path);

}  // namespace wishbone
