#include "identification/mode_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

namespace wishbone {
namespace {

struct Describe {
  std::string operator()(const AllModes&) const { return "all normal modes"; }
  std::string operator()(const LowestModes& lowest) const {
    return lowest.count == 1 ? "the lowest normal mode"
                             : fmt::format("the {} lowest normal modes", lowest.count);
  }
  std::string operator()(const ModesBelow& below) const {
    return fmt::format("the normal modes below {:.6g} Hz", below.omega / (2 * std::numbers::pi));
  }
  std::string operator()(const ListedModes& listed) const {
    return fmt::format("normal mode{} {}", listed.numbers.size() == 1 ? "" : "s",
                       fmt::join(listed.numbers, ", "));
  }
};

}  // namespace

std::string describe(const ModeChoice& choice) {
  return std::visit(Describe(), choice);
}

}  // namespace wishbone
