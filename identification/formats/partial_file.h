#pragma once

#include <string>

namespace wishbone {

/// A file that bears the name PATH.partial until it is whole, so that a writer that fails leaves whatever had
/// the name PATH before as it was.
class PartialFile {
 public:
  explicit PartialFile(std::string path) : path_(std::move(path)), name_(path_ + ".partial") {}
  /// Removes the file unless it was finished.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Where to write.
  const std::string& name() const { return name_; }
  /// The name that the file is to have in the end.
  const std::string& path() const { return path_; }
  /// Gives the file, which must be closed, its final name. Throws NumericsError when that fails.
  void finish();

 private:
  std::string path_, name_;
  bool finished_ = false;
};

}  // namespace wishbone
