#include "identification/formats/uff_systems.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr int kGlobal = 1;

auto find(const std::vector<UffCoordinateSystem>& systems, int number) {
  return std::find_if(systems.begin(), systems.end(),
                      [&](const auto& system) { return system.number == number; });
}

}  // namespace

bool is_undefined_global(const std::vector<UffCoordinateSystem>& systems, int number) {
  return number == kGlobal && find(systems, number) == systems.end();
}

UffFrame uff_frame(const std::vector<UffCoordinateSystem>& systems, int number, const std::string& file) {
  const auto refuse = [&](std::string what, int which, std::string remedy) {
    throw InputError({file, std::move(what), fmt::format("coordinate system {}", which), std::move(remedy)});
  };
  UffFrame frame;
  std::size_t steps = 0;
  while (number != 0 && !is_undefined_global(systems, number)) {
    const auto system = find(systems, number);
    if (system == systems.end())
      refuse("a coordinate system is referred to and not defined", number, "write it as dataset 18 or 2420");
    if (system->type != 0)
      refuse("a coordinate system that is referred to must be Cartesian", number,
             "write nodes and shapes in Cartesian coordinates");
    if (++steps > systems.size())
      refuse("coordinate systems refer to each other in a circle", number, "let one of them refer to 0");
    frame = {system->origin + system->axes * frame.origin, system->axes * frame.axes};
    number = system->reference;
  }
  return frame;
}

}  // namespace wishbone
