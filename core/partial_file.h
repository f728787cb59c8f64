#pragma once

#include <string>
#include <string_view>

#include "core/descriptor.h"

namespace wishbone {

/// A file takes the place of whatever bears its name, which must not be a device, a pipe or a folder, be it by way of a link.
/// @throws NumericsError when it is
void check_is_file_or_free(const std::string& path);

/// A file that bears another name in the same folder, PATH.partial-XXXXXX, until it is whole and on the disk: a writer that fails
/// or is killed leaves whatever had the name PATH before as it was, and two writers never mix. Every failure is a NumericsError
/// with the operating system's reason. What has the name PATH and is no file is refused before anything is made.
class PartialFile {
 public:
  /// Whether a file of that name is, or was left by, a writer of `path` that has not finished.
  static bool is_name_of(std::string_view name, std::string_view path);

  /// Makes the file, empty.
  explicit PartialFile(std::string path);
  /// Removes the file unless it was finished.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Where to write; for writers that open it themselves.
  const std::string& name() const { return descriptor_.path(); }
  /// The name that the file is to have in the end.
  const std::string& path() const { return path_; }
  /// Appends bytes, by way of a buffer.
  void write(std::string_view bytes);
  /// Puts the file on the disk and gives it its final name. Who opened it by name has closed it.
  void finish();

 private:
  void flush();

  std::string path_;
  Descriptor descriptor_;
  std::string buffer_;
  std::size_t size_ = 0;
  bool finished_ = false;
};

/// Writes a whole file; see PartialFile.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace wishbone
