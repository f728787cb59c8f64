#include "app/check_output.h"

#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "identification/formats/modal_file.h"

namespace wishbone {

namespace {

namespace fs = std::filesystem;

void check_folder(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code unknown;
  if (!fs::is_directory(folder, unknown))
    throw InputError({path.string(), "there is no such folder to write to", folder.string(),
                      "make the folder first, or write to another one"});
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError({path.string(), "this folder cannot be written to", folder.string(),
                      "check its permissions, or write to another folder"});
}

/// What has the name already must be a file that may be replaced.
void check_replaceable(const fs::path& path, const std::vector<std::string>& inputs) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return;
  if (status.type() == fs::file_type::none)
    throw InputError({path.string(), "no file can be made under this name", error.message(),
                      "give the output another name"});
  if (!fs::is_regular_file(status))
    throw InputError({path.string(), "a folder, a device or the like has the name of the output", "",
                      "give the output the name of a file"});
  if (access(path.c_str(), W_OK) != 0)
    throw InputError({path.string(), "the file is there already and may not be written", "",
                      "check its permissions, or give the output another name"});
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, error))
      throw InputError(
          {path.string(), "the output would replace an input", input, "give the output a name of its own"});
}

}  // namespace

void check_modal_output(const std::string& path, const std::vector<std::string>& inputs) {
  for (const auto& file : modal_data_files(path)) check_output(file.string(), inputs);
}

void check_output_folder(const std::string& path) {
  if (path.empty()) throw InputError({"", "the name of the output folder is empty", "", "name a folder"});
  std::error_code unknown;
  fs::path folder = path;
  if (!folder.has_filename()) folder = folder.parent_path();  // "name/"
  if (fs::is_directory(folder, unknown)) return check_folder(folder / "file");
  if (fs::exists(folder, unknown))
    throw InputError({path, "a file has the name of the output folder", "", "give the folder another name"});
  check_folder(folder);
}

void check_output(const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) throw InputError({"", "the name of the output is empty", "", "name a file to write"});
  check_folder(path);
  check_replaceable(path, inputs);
  check_replaceable(path + ".partial", inputs);
}

}  // namespace wishbone
