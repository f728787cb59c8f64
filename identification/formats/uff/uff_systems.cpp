#include "identification/formats/uff/uff_systems.h"

#include <fmt/format.h>

#include <utility>

#include "core/error.h"

namespace wishbone {

UffSystems::UffSystems(const std::vector<UffCoordinateSystem>& systems, std::string where)
    : where_(std::move(where)) {
  for (const UffCoordinateSystem& system : systems) systems_.emplace(system.number, &system);
}

const UffFrame& UffSystems::frame(int number) {
  const auto refuse = [&](std::string what, int which, std::string remedy) {
    throw InputError(
        {where_, std::move(what), fmt::format("coordinate system {}", which), std::move(remedy)});
  };
  // the systems on the way to one whose frame is known, and back
  std::vector<const UffCoordinateSystem*> way;
  int next = number;
  while (!is_global(next) && !frames_.contains(next)) {
    const auto system = systems_.find(next);
    if (system == systems_.end())
      refuse("a coordinate system is referred to and not defined", next, "write it as dataset 18 or 2420");
    if (system->second->type != 0)
      refuse("a coordinate system that is referred to must be Cartesian", next,
             "write nodes and shapes in Cartesian coordinates");
    way.push_back(system->second);
    if (way.size() > systems_.size())
      refuse("coordinate systems refer to each other in a circle", next, "let one of them refer to 0");
    next = system->second->reference;
  }
  for (; !way.empty(); way.pop_back()) {
    const UffCoordinateSystem& system = *way.back();
    const UffFrame& base = frames_[system.reference];  // global ones are the identity
    const UffFrame frame = {base.origin + base.axes * system.origin, base.axes * system.axes};
    frames_[system.number] = frame;
  }
  return frames_[number];
}

}  // namespace wishbone
