#include "identification/formats/partial_file.h"

#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace wishbone {

PartialFile::~PartialFile() {
  std::error_code unknown;
  if (!finished_) std::filesystem::remove(name_, unknown);
}

void PartialFile::finish() {
  std::error_code error;
  std::filesystem::rename(name_, path_, error);
  if (error)
    throw NumericsError({path_, "cannot give the file its final name: " + error.message(), "",
                         "check the permissions of the folder"});
  finished_ = true;
}

}  // namespace wishbone
