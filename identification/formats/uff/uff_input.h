#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace wishbone {

/// The lines and binary blocks of a Universal File, read through a small buffer: memory does not grow with
/// the file. Lines end with LF, CR LF or CR. Knows the place in the file, so that every error names it.
class UffInput {
 public:
  /// Of a stream at its begin that can be repositioned; errors call it `name`.
  UffInput(std::istream& stream, std::string name);

  /// Goes to the next line; false at the end of the file.
  bool advance();
  /// The next advance() finds the current line again.
  void put_back() { put_back_ = true; }

  /// Of the current line, without its end; at most kLongestLine bytes.
  std::string_view text() const { return text_; }
  std::size_t line() const { return line_; }  ///< from 1
  /// "    -1" and nothing but blanks; -1 in other columns where the dataset was opened so, or where the lines that
  /// follow tell that it is closed here.
  bool at_delimiter();
  /// Whether the current line, between two datasets, opens one: -1 in any columns, which then closes it too.
  bool at_opening();

  /// Goes to the next line of the current dataset; false at its delimiter. Throws InputError at the end of
  /// the file.
  bool advance_in_dataset();
  /// The same for a line that must be there: `what` it is, for the message.
  std::string_view require(std::string_view what);
  /// The same for a line that is not blank.
  std::string_view require_filled(std::string_view what);
  /// The same for the last line before a binary block: where lines end with CR alone, an LF behind it belongs
  /// to the block.
  std::string_view require_before_binary(std::string_view what);
  /// Goes to the delimiter; throws InputError if anything but blank lines comes before it.
  void end_dataset();
  void skip_dataset();
  /// The dataset that errors name; may be empty.
  void set_dataset(std::string name) { dataset_ = std::move(name); }
  const std::string& dataset() const { return dataset_; }

  /// Bytes of the file behind the current line.
  std::uintmax_t bytes_left() const { return size_ - next_offset_; }
  /// Whether the delimiter follows `bytes` after the end of the current line, with or without a new line
  /// before it.
  bool delimiter_follows(std::uintmax_t bytes);
  /// The next `bytes` bytes, which must be there, straight into `target`.
  void read_binary(char* target, std::size_t bytes);

  /// Of the byte behind the current line or binary block, from the beginning of the file.
  std::uintmax_t next_offset() const { return next_offset_; }

  /// Throws InputError at `column` (from 0) of the current line.
  [[noreturn]] void fail(std::string what, std::string_view found, std::string remedy,
                         std::size_t column = 0) const;
  /// The same about the current line as a whole.
  [[noreturn]] void fail_line(std::string what, std::string remedy) const;

  static constexpr std::size_t kLongestLine = 4096;

 private:
  static constexpr std::size_t kAhead = 256;  ///< bytes that are looked at before they are read

  bool fill();
  void read_line_end();
  std::string text_ahead(std::uintmax_t bytes);
  bool closes_here();

  std::istream& stream_;
  std::string name_;
  std::uintmax_t size_ = 0;
  std::string dataset_;

  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;  ///< what is left of the buffer
  std::string text_;
  std::string opening_ = "    -1";  ///< of the current dataset
  std::size_t line_ = 0;
  std::uintmax_t offset_ = 0;       ///< of the current line
  std::uintmax_t next_offset_ = 0;  ///< behind its end
  bool put_back_ = false;
  bool too_long_ = false;
  bool lone_cr_ = false;  ///< the last line ended with CR alone
  bool is_before_binary_ = false;
};

}  // namespace wishbone
