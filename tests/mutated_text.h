#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <string_view>

namespace wishbone {

/// How far random edits go, and the characters that mean something to the reader under test.
struct Mutation {
  std::string_view telling;
  std::size_t most_edits, longest_removal, longest_copy;
};

/// A few random edits: bytes changed, removed, doubled, or a piece copied elsewhere.
inline std::string mutated(std::string text, const Mutation& mutation, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  const std::string_view telling = mutation.telling;
  for (std::size_t edits = 1 + below(mutation.most_edits); edits > 0; --edits) {
    const std::size_t at = below(text.size());
    switch (random() % 5) {
      case 0:
        text[at] = telling[below(telling.size())];
        break;
      case 1:
        text.erase(at, 1 + below(mutation.longest_removal));
        break;
      case 2:
        text.insert(at, 1 + below(3), telling[below(telling.size())]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size()), below(mutation.longest_copy)));
        break;
      default:
        text[at] = static_cast<char>(random());
        break;
    }
  }
  return text;
}

}  // namespace wishbone
