#include "identification/mode_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

namespace wishbone {
namespace {

struct Describe {
  std::string_view kind;

  std::string operator()(const AllModes&) const { return fmt::format("all {} modes", kind); }
  std::string operator()(const LowestModes& lowest) const {
    return lowest.count == 1 ? fmt::format("the lowest {} mode", kind)
                             : fmt::format("the {} lowest {} modes", lowest.count, kind);
  }
  std::string operator()(const ModesBelow& below) const {
    return fmt::format("the {} modes below {:.6g} Hz", kind, below.omega / (2 * std::numbers::pi));
  }
  std::string operator()(const ListedModes& listed) const {
    return fmt::format("{} mode{} {}", kind, listed.numbers.size() == 1 ? "" : "s",
                       fmt::join(listed.numbers, ", "));
  }
};

}  // namespace

std::string describe(const ModeChoice& choice, std::string_view kind) {
  return std::visit(Describe{kind}, choice);
}

}  // namespace wishbone
