#include "identification/formats/uff/uff_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

using Fields = std::vector<std::string_view>;

bool is_number(std::string_view field) {
  return !field.empty() && number_length(field) == field.size();
}

bool is_integer(std::string_view field) {
  return integer_in(field).has_value();
}

using Test = bool (*)(std::string_view);

bool all_blank_or(Test is_valid, const Fields& fields) {
  return std::all_of(fields.begin(), fields.end(), [&](auto f) { return f.empty() || is_valid(f); });
}

Fields columns_of(std::string_view line, std::initializer_list<int> widths) {
  Fields fields;
  line = without_trailing_blanks(line);
  for (std::size_t at = 0; at < line.size();) {
    const auto width = static_cast<std::size_t>(widths.begin()[fields.size() % widths.size()]);
    fields.push_back(columns(line, at, width));
    at += width;
  }
  return fields;
}

/// Numbers stand at the right end of their columns, so that a line that keeps other columns shows by blanks
/// there.
bool right_justified(const Fields& fields) {
  return std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
    return trimmed(field).empty() || (field.back() != ' ' && field.back() != '\t');
  });
}

/// Whether a border between columns goes through a word that is a number as a whole.
bool cut_numbers(Test is_valid, const Fields& fields, const Fields& words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    return is_valid(word) && std::any_of(fields.begin(), fields.end(), [&](std::string_view field) {
             return word.data() < field.data() && field.data() < word.data() + word.size();
           });
  });
}

Fields pulled_apart(std::string_view line) {
  Fields numbers;
  for (std::string_view word : words_of(line)) {
    while (!word.empty()) {
      std::size_t length = number_length(word);
      if (length == 0) length = word.size();
      numbers.push_back(word.substr(0, length));
      word.remove_prefix(length);
    }
  }
  return numbers;
}

constexpr const char* kNumberRemedy = "write a finite number as Fortran does, such as 1.00000E+00";

/// As number_fields, of fields that are valid.
Fields valid_fields(const UffInput& in, std::initializer_list<int> widths, std::size_t expected,
                    Test is_valid) {
  const Fields words = words_of(in.text());
  const bool words_are_numbers = all_blank_or(is_valid, words);
  if (words_are_numbers && (expected == 0 || words.size() == expected)) return words;

  Fields fields = columns_of(in.text(), widths);
  const bool fits = right_justified(fields);
  const bool cuts = cut_numbers(is_valid, fields, words);
  for (auto& field : fields) field = trimmed(field);
  const bool touching = fields.size() == expected && words.size() < expected;
  if (fits && all_blank_or(is_valid, fields) && (!cuts || touching)) return fields;
  if (words_are_numbers) return words;

  Fields numbers = pulled_apart(in.text());
  if (!all_blank_or(is_valid, numbers)) {
    const std::string_view word = *std::find_if_not(words.begin(), words.end(), is_valid);
    fail_field(in, word, "expected a number", kNumberRemedy);
  }
  return numbers;
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view text) {
  Fields words;
  for (std::size_t at = 0;;) {
    at = text.find_first_not_of(" \t", at);
    if (at == std::string_view::npos) return words;
    const std::size_t stop = std::min(text.find_first_of(" \t", at), text.size());
    words.push_back(text.substr(at, stop - at));
    at = stop;
  }
}

std::string_view columns(std::string_view line, std::size_t begin, std::size_t width) {
  return begin < line.size() ? line.substr(begin, width) : line.substr(line.size());
}

std::vector<std::string_view> number_fields(const UffInput& in, std::initializer_list<int> widths,
                                            std::size_t expected) {
  return valid_fields(in, widths, expected, is_number);
}

void fail_field(const UffInput& in, std::string_view field, std::string what, std::string remedy) {
  const auto column = field.empty() ? 0 : static_cast<std::size_t>(field.data() - in.text().data());
  in.fail(std::move(what), field, std::move(remedy), column);
}

int integer_field(const UffInput& in, std::string_view field, std::string_view what) {
  if (trimmed(field).empty()) return 0;
  const auto value = integer_in(field);
  if (!value)
    fail_field(in, trimmed(field), fmt::format("expected {}, a whole number", what),
               "write whole numbers of at most 2147483647");
  return *value;
}

double real_field(const UffInput& in, std::string_view field, std::string_view what) {
  if (trimmed(field).empty()) return 0;
  const auto value = real_in(field);
  if (!value)
    fail_field(in, trimmed(field), fmt::format("expected {}, a finite number", what), kNumberRemedy);
  return *value;
}

std::vector<int> integers_of_line(const UffInput& in, int width, std::size_t expected,
                                  std::string_view what) {
  std::vector<int> integers;
  for (const std::string_view field : valid_fields(in, {width}, expected, is_integer))
    integers.push_back(integer_field(in, field, what));
  integers.resize(std::max(integers.size(), expected));
  return integers;
}

void append_reals(const UffInput& in, int width, std::string_view what, std::vector<double>& reals) {
  for (const std::string_view field : number_fields(in, {width}))
    reals.push_back(real_field(in, field, what));
}

}  // namespace wishbone
