#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "temporary_folder.h"

namespace wishbone {

/// Text files in a folder of their own, removed with it.
class TextFiles {
 public:
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  /// `message` without the path of the folder, so that it can be compared.
  std::string relative(std::string message) const {
    const std::string prefix = folder_ / "";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) {
      message.erase(at, prefix.size());
    }
    return message;
  }

 private:
  TemporaryFolder folder_;
};

/// The text of the error E that `step` throws; "nothing was thrown" otherwise.
template <class E, class Step>
std::string message_of(Step step) {
  try {
    step();
  } catch (const E& e) {
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace wishbone
