#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace wishbone::fuzz {

/// One reader and one of the files that it reads: that which is mutated.
struct Input {
  std::filesystem::path file;
  std::function<void()> read;
  std::string bytes;  ///< of the intact file
};

struct Reader {
  std::string name;
  unsigned share;  ///< of all inputs
  std::vector<Input> inputs;
};

/// Every reader of files from outside. The intact files are put into `folder`, where they are read.
std::vector<Reader> readers(const std::filesystem::path& folder);

}  // namespace wishbone::fuzz
