#include "identification/formats/uff/uff_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

constexpr std::size_t kBufferSize = 1 << 16;
constexpr std::string_view kDelimiter = "    -1";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_delimiter(std::string_view text) {
  return text.starts_with(kDelimiter) &&
         text.find_first_not_of(' ', kDelimiter.size()) == std::string_view::npos;
}

bool is_minus_one(std::string_view text) {
  return trimmed(text) == "-1";
}

/// The first line of a text that is not blank, and the text behind it.
std::string_view take_filled_line(std::string_view& text) {
  std::string_view line;
  while (line.empty() && !text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return line;
}

}  // namespace

UffInput::UffInput(std::istream& stream, std::string name)
    : stream_(stream), name_(std::move(name)), buffer_(kBufferSize) {
  stream_.seekg(0, std::ios::end);
  size_ = static_cast<std::uintmax_t>(std::max<std::streamoff>(stream_.tellg(), 0));
  stream_.seekg(0);
  if (fill() && std::string_view(buffer_.data(), end_).starts_with(kByteOrderMark))
    at_ = next_offset_ = kByteOrderMark.size();
}

bool UffInput::fill() {
  if (at_ < end_) return true;
  stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  at_ = 0;
  end_ = static_cast<std::size_t>(stream_.gcount());
  return end_ > 0;
}

bool UffInput::advance() {
  if (put_back_) {
    put_back_ = false;
    return true;
  }
  offset_ = next_offset_;
  text_.clear();
  too_long_ = false;
  if (!fill()) return false;
  ++line_;
  while (fill()) {
    const char* begin = buffer_.data() + at_;
    const char* stop =
        std::find_if(begin, begin + (end_ - at_), [](char c) { return c == '\n' || c == '\r'; });
    const auto length = static_cast<std::size_t>(stop - begin);
    const std::size_t kept = std::min(length, kLongestLine - text_.size());
    text_.append(begin, kept);
    too_long_ = too_long_ || kept < length;
    at_ += length;
    next_offset_ += length;
    if (at_ == end_) continue;
    read_line_end();
    break;
  }
  return true;
}

void UffInput::read_line_end() {
  const bool is_cr = buffer_[at_] == '\r';
  ++at_, ++next_offset_;
  const bool is_lf_next = is_cr && fill() && buffer_[at_] == '\n';
  if (is_lf_next && !(is_before_binary_ && lone_cr_)) {
    ++at_, ++next_offset_;
    lone_cr_ = false;
  } else {
    lone_cr_ = is_cr;
  }
}

bool UffInput::at_delimiter() {
  if (too_long_) return false;
  if (is_delimiter(text_)) return true;
  return is_minus_one(text_) && (without_trailing_blanks(text_) == opening_ || closes_here());
}

bool UffInput::at_opening() {
  if (too_long_ || !is_minus_one(text_)) return false;
  opening_ = without_trailing_blanks(text_);
  return true;
}

/// A lone -1 may be a value too. It closes the dataset where the file ends behind it, or where another one opens:
/// -1 and a number.
bool UffInput::closes_here() {
  const std::string ahead = text_ahead(0);
  std::string_view rest = ahead;
  const std::string_view next = take_filled_line(rest);
  if (next.empty()) return bytes_left() <= kAhead;
  const std::string_view number = take_filled_line(rest);
  return is_minus_one(next) && !number.empty() && number.find_first_of("0123456789") == 0;
}

/// The next kAhead bytes, from `bytes` behind the current line.
std::string UffInput::text_ahead(std::uintmax_t bytes) {
  std::string text(kAhead, '\0');
  stream_.clear();
  const auto resume = static_cast<std::streamoff>(next_offset_ + (end_ - at_));
  stream_.seekg(static_cast<std::streamoff>(next_offset_ + bytes));
  stream_.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream_.gcount()));
  stream_.clear();
  stream_.seekg(resume);
  return text;
}

bool UffInput::advance_in_dataset() {
  if (!advance())
    fail("the file ends before the delimiter '    -1' of the dataset", "",
         "the file was cut off: get it again");
  if (at_delimiter()) return false;
  if (too_long_)
    fail_line(fmt::format("a line is longer than {} bytes", kLongestLine), "name a Universal File");
  return true;
}

std::string_view UffInput::require(std::string_view what) {
  if (!advance_in_dataset())
    fail(fmt::format("expected {}", what), "the delimiter",
         "the dataset is incomplete: write it again with all its records");
  return text_;
}

std::string_view UffInput::require_filled(std::string_view what) {
  while (trimmed(require(what)).empty()) continue;
  return text_;
}

std::string_view UffInput::require_before_binary(std::string_view what) {
  is_before_binary_ = true;
  require(what);
  is_before_binary_ = false;
  return text_;
}

void UffInput::end_dataset() {
  while (advance_in_dataset())
    if (!trimmed(text_).empty())
      fail_line("expected the delimiter '    -1'",
                "compare the counts that the dataset announces with what it holds");
}

void UffInput::skip_dataset() {
  do {
    if (!advance())
      fail("the file ends before the delimiter '    -1' of the dataset", "",
           "the file was cut off: get it again");
  } while (!at_delimiter());
}

bool UffInput::delimiter_follows(std::uintmax_t bytes) {
  if (bytes > bytes_left()) return false;
  const std::string ahead = text_ahead(bytes);
  std::string_view text = ahead;
  text.remove_prefix(std::min(text.find_first_not_of("\r\n"), text.size()));
  text = text.substr(0, text.find_first_of("\r\n"));
  return is_delimiter(text) || without_trailing_blanks(text) == opening_;
}

void UffInput::read_binary(char* target, std::size_t bytes) {
  if (bytes == 0) return;
  const std::size_t buffered = std::min(bytes, end_ - at_);
  std::memcpy(target, buffer_.data() + at_, buffered);
  at_ += buffered;
  stream_.read(target + buffered, static_cast<std::streamsize>(bytes - buffered));
  next_offset_ += bytes;
  if (!stream_) fail("the binary values cannot be read", "", "check the disk and the file");
}

void UffInput::fail(std::string what, std::string_view found, std::string remedy, std::size_t column) const {
  const std::string where =
      fmt::format("{}:{} (byte {})", name_, std::max<std::size_t>(line_, 1), offset_ + column);
  const std::string prefix = dataset_.empty() ? "" : fmt::format("dataset {}: ", dataset_);
  throw InputError({where, prefix + std::move(what), shown(found), std::move(remedy)});
}

void UffInput::fail_line(std::string what, std::string remedy) const {
  const std::size_t first = std::min(text_.find_first_not_of(' '), text_.size());
  fail(std::move(what), trimmed(text_), std::move(remedy), first);
}

}  // namespace wishbone
