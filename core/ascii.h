#pragma once

/// Kinds of characters of names and numbers, in ASCII alone, whatever the locale.
namespace wishbone {

/// The underscore counts as a letter.
constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace wishbone
