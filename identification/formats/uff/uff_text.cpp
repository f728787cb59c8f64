#include "identification/formats/uff/uff_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/ascii.h"
#include "core/utf8.h"

namespace wishbone {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kLongestShown = 60;

std::size_t digits_at(std::string_view text, std::size_t at) {
  std::size_t n = 0;
  while (at + n < text.size() && is_digit(text[at + n])) ++n;
  return n;
}

bool sign_at(std::string_view text, std::size_t at) {
  return at < text.size() && (text[at] == '+' || text[at] == '-');
}

/// Length of "E+05", "d5", "-101" at `at`; 0 when there is no exponent.
std::size_t exponent_length(std::string_view text, std::size_t at) {
  if (at >= text.size()) return 0;
  if (std::string_view("EeDdQq").find(text[at]) != std::string_view::npos) {
    const std::size_t lead = 1 + (sign_at(text, at + 1) ? 1 : 0);
    const std::size_t n = digits_at(text, at + lead);
    return n == 0 ? 0 : lead + n;
  }
  if (!sign_at(text, at) || digits_at(text, at + 1) != 3) return 0;
  const bool is_next_number = at + 4 < text.size() && text[at + 4] == '.';
  return is_next_number ? 0 : 4;
}

}  // namespace

std::string_view without_trailing_blanks(std::string_view text) {
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);  // npos + 1 == 0: nothing but blanks
}

std::string_view trimmed(std::string_view text) {
  text = without_trailing_blanks(text);
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text;
}

std::string shown(std::string_view found) {
  if (found.empty()) return "";
  std::string text = as_utf8(found.substr(0, kLongestShown));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
      '?');
  return fmt::format("'{}{}'", text, found.size() > kLongestShown ? "..." : "");
}

std::size_t number_length(std::string_view text) {
  std::size_t at = sign_at(text, 0) ? 1 : 0;
  const std::size_t whole = digits_at(text, at);
  at += whole;
  std::size_t fraction = 0;
  if (at < text.size() && text[at] == '.') {
    fraction = digits_at(text, at + 1);
    at += 1 + fraction;
  }
  if (whole + fraction == 0) return 0;
  return at + exponent_length(text, at);
}

std::optional<double> real_in(std::string_view field) {
  field = trimmed(field);
  if (field.empty() || number_length(field) != field.size()) return std::nullopt;
  if (field[0] == '+') field.remove_prefix(1);
  std::string number(field);
  const auto letter = number.find_first_of("EeDdQq");
  const auto sign = number.find_first_of("+-", 1);
  if (letter != std::string::npos)
    number[letter] = 'e';
  else if (sign != std::string::npos)
    number.insert(sign, 1, 'e');
  if (const auto plus = number.find('+'); plus != std::string::npos) number.erase(plus, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::result_out_of_range)
    return number.find("e-") != std::string::npos ? std::optional(0.0) : std::nullopt;
  return error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<int> integer_in(std::string_view field) {
  field = trimmed(field);
  if (field.starts_with('+')) field.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc() && end == field.data() + field.size()) return value;
  const auto real = real_in(field);
  if (!real || std::abs(*real) > 2e9 || *real != std::trunc(*real)) return std::nullopt;
  return static_cast<int>(*real);
}

}  // namespace wishbone
