#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace wishbone {

/// Reads a text file line by line, however large it is, and knows where every character of the line stands.
///
/// Lines end with LF or CR LF; a byte order mark of UTF-8 is passed over. Throws InputError for a file that is
/// missing, not a file, or cannot be read, for bytes that are not text, and for lines of more than
/// kLongestLine bytes.
class LineReader {
 public:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

  explicit LineReader(const std::filesystem::path& path);

  /// Goes to the next line; false at the end of the file, where the line is empty.
  bool next();
  /// The line without its end; valid until next().
  std::string_view line() const { return line_; }
  /// Bytes from the start of this line to the end of the file: what is left cannot hold more.
  std::uintmax_t bytes_left() const { return size_ - offset_; }
  const std::string& path() const { return path_; }

  /// "file:line (byte OFFSET)" of `token`, a part of line(); lines count from 1, bytes from 0.
  std::string where(std::string_view token) const;
  std::string where() const { return where(line_.substr(0, 0)); }
  /// Throws InputError at `token`, a part of line(), which is shown as the value.
  [[noreturn]] void reject(std::string_view token, std::string what, std::string remedy) const;

  /// The number that `token` is, finite; throws InputError at it when it is anything else.
  double number(std::string_view token) const;
  /// The integer that `token` is.
  std::int64_t integer(std::string_view token) const;

 private:
  void check_text() const;

  std::string path_;
  std::uintmax_t size_ = 0;
  std::ifstream stream_;
  std::vector<char> buffer_;
  std::string_view line_;
  std::int64_t line_number_ = 0;
  std::uintmax_t offset_ = 0;  ///< of the first byte of line_
  std::uintmax_t next_offset_ = 0;
};

/// `text` without blanks and tabs at its ends.
std::string_view without_blanks(std::string_view text);

/// `text` in quotes for messages: shortened when it is long, bytes that are not printable as \xNN.
std::string in_quotes(std::string_view text);

}  // namespace wishbone
