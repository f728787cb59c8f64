#include "core/input_file.h"

#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>

namespace wishbone {
namespace {

bool is_made_up_by_the_kernel(const std::filesystem::path& path) {
  constexpr std::array<unsigned long, 5> kKinds{PROC_SUPER_MAGIC, SYSFS_MAGIC, DEBUGFS_MAGIC, TRACEFS_MAGIC,
                                                SECURITYFS_MAGIC};
  struct statfs system {};
  return statfs(path.c_str(), &system) == 0 &&
         std::ranges::find(kKinds, static_cast<unsigned long>(system.f_type)) != kKinds.end();
}

}  // namespace

std::optional<InputFault> input_fault(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return InputFault{"there is no such file", "check the name"};
  if (std::filesystem::is_directory(status))
    return InputFault{"this is a directory, not a file", "name the file in it"};
  if (!std::filesystem::is_regular_file(status) || is_made_up_by_the_kernel(path))
    return InputFault{"this is a pipe, a device or the like, not a file on a disk",
                      "save what it gives as a file, and name that"};
  if (access(path.c_str(), R_OK) != 0)
    return InputFault{"the file cannot be opened", "check its permissions"};
  return {};
}

}  // namespace wishbone
