#include "identification/formats/line_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/input_file.h"

namespace wishbone {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t') || byte == 0x7f;
}

std::string_view without_plus(std::string_view token) {
  const bool is_signed = token.size() > 1 && token[0] == '+' && token[1] != '-';
  return is_signed ? token.substr(1) : token;
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& path) : path_(path.string()), buffer_(kLongestLine + 2) {
  std::error_code error;
  if (const auto fault = input_fault(path)) throw InputError({path_, fault->what, "", fault->remedy});
  size_ = std::filesystem::file_size(path, error);
  stream_.open(path, std::ios::binary);
  if (error || !stream_) throw InputError({path_, "cannot open the file", "", "check its permissions"});
}

bool LineReader::next() {
  stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  const auto count = static_cast<std::size_t>(stream_.gcount());
  offset_ = next_offset_;
  next_offset_ += count;
  ++line_number_;
  if (stream_.bad()) throw InputError({path_, "cannot read the file", "", "check the disk"});
  // the end of the file ends the last line too, and is not counted
  const std::size_t length = stream_.eof() || stream_.fail() ? count : count - 1;
  line_ = {buffer_.data(), length};
  if (stream_.fail() && !stream_.eof())
    reject(line_, fmt::format("a line has more than {} bytes", kLongestLine), "is this a text file?");
  if (count == 0) return false;
  if (line_number_ == 1 && line_.starts_with(kByteOrderMark)) {
    line_.remove_prefix(kByteOrderMark.size());
    offset_ += kByteOrderMark.size();
  }
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  check_text();
  return true;
}

void LineReader::check_text() const {
  const auto found = std::find_if(line_.begin(), line_.end(), is_control);
  if (found == line_.end()) return;
  const auto at = static_cast<std::size_t>(found - line_.begin());
  reject(line_.substr(at, 1), "the file is not text", "name a text file");
}

std::string LineReader::where(std::string_view token) const {
  const auto column = static_cast<std::uintmax_t>(token.data() - line_.data());
  return fmt::format("{}:{} (byte {})", path_, line_number_, offset_ + column);
}

void LineReader::reject(std::string_view token, std::string what, std::string remedy) const {
  throw InputError({where(token), std::move(what), token.empty() ? "" : in_quotes(token), std::move(remedy)});
}

double LineReader::number(std::string_view token) const {
  const std::string_view digits = without_plus(token);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range)
    reject(token, "the number does not fit a double",
           "magnitudes from 2.3e-308 to 1.7e308, and 0, can be held");
  // from_chars takes "inf" and "nan" for numbers
  if (error != std::errc() || end != digits.data() + digits.size() || !(value - value == 0))
    reject(token, token.empty() ? "a number is missing" : "not a finite number",
           "write a number with a decimal point, such as 0.5 or 1e-3");
  return value;
}

std::int64_t LineReader::integer(std::string_view token) const {
  const std::string_view digits = without_plus(token);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) reject(token, "the integer is too large", "use a smaller one");
  if (error != std::errc() || end != digits.data() + digits.size())
    reject(token, token.empty() ? "an integer is missing" : "not an integer", "write digits only");
  return value;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return text.substr(0, 0);
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, kShown)) {
    if (is_control(c))
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      shown += c;
  }
  return shown + (text.size() > kShown ? "...'" : "'");
}

}  // namespace wishbone
