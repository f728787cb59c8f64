#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace wishbone {

/// Which elastic normal modes of a free body are kept. Modes are numbered from 1 in ascending frequency, rigid-body
/// modes not counted.
struct AllModes {};
struct LowestModes {
  int count = 0;
};
struct ModesBelow {
  double omega = 0;  ///< [rad/s]
};
struct ListedModes {
  std::vector<int> numbers;  ///< ascending, each once
};
using ModeChoice = std::variant<AllModes, LowestModes, ModesBelow, ListedModes>;

/// "all normal modes", "the 10 lowest normal modes", "the normal modes below 200 Hz", "normal modes 1, 2, 5", or of another
/// `kind` than normal.
std::string describe(const ModeChoice& choice, std::string_view kind = "normal");

/// What the chosen normal modes are modes of.
enum class NormalModes {
  of_free_body,
  of_held_interfaces  ///< of the body held at its interfaces, beside their constraint modes [Craig, Bampton 1968]
};

}  // namespace wishbone
