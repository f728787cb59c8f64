#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <utility>

#include "core/partial_file.h"

namespace wishbone {

/// Writes a text file piece by piece; it has its name once it is whole. Doubles printed by "{}" have the fewest
/// digits, 17 at most, that give the same double when they are read back.
class TextWriter {
 public:
  /// Throws NumericsError when no file can be made there.
  explicit TextWriter(const std::filesystem::path& path) : file_(path.string()) {}

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() >= kBufferSize) flush();
  }

  /// Writes the rest, and gives the file its name. Throws NumericsError when anything could not be written.
  void close();

 private:
  static constexpr std::size_t kBufferSize = 1 << 16;

  void flush();

  PartialFile file_;
  fmt::memory_buffer buffer_;
};

}  // namespace wishbone
