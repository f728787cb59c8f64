#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/did_you_mean.h"
#include "core/error.h"
#include "core/units.h"

namespace wishbone {

/// The positive number that an option was given, with or without a unit, in SI.
/// @throws InputError naming the option
double positive_value(const std::string& option, const std::string& text, const Dimension& dimension);

/// The meaning of one of a few words that an option was given. `kind` names them in the message ("the forms").
/// @throws InputError naming the option
template <class Enum>
Enum named_value(const std::string& option, const std::string& text,
                 const std::vector<std::pair<std::string, Enum>>& choices, std::string_view kind) {
  std::vector<std::string> words;
  for (const auto& [word, meaning] : choices) {
    if (word == text) return meaning;
    words.push_back(word);
  }
  throw InputError(
      {option, "not one of " + std::string(kind), "'" + text + "'", did_you_mean(text, words, kind)});
}

}  // namespace wishbone
