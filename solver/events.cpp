#include "solver/events.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/loads.h"

namespace wishbone {
namespace {

/// Calls f(element, index of the force element) for every element that has segments.
template <class F>
void for_each_segmented(const System& system, F&& f) {
  for_each_force(system, [&](const auto& element, int index) {
    if constexpr (requires { element.edges(0); })
      if (element.has_segments()) f(element, index);
  });
}

template <class Element>
double position(const Element& element, int index, const Workspace& ws) {
  return element.position({.markers = ws.markers, .angle = ws.memory.force_angles[index]});
}

/// Distances inside the lower and the upper edge; one from an edge that is not there.
std::array<double, 2> distances(double position, const Edges& edges) {
  const auto distance = [](double value) { return std::isfinite(value) ? value : 1.0; };
  return {distance(position - edges.lower), distance(edges.upper - position)};
}

}  // namespace

int event_count(const System& system) {
  int count = 0;
  for_each_segmented(system, [&](const auto&, int) { count += 2; });
  return count;
}

void initialize_segments(const System& system, Workspace& ws) {
  for_each_segmented(system, [&](const auto& element, int index) {
    ws.memory.segments[index] = element.segment_at(position(element, index, ws));
  });
}

void calc_events(const System& system, const Workspace& ws, std::span<double> g) {
  std::size_t i = 0;
  for_each_segmented(system, [&](const auto& element, int index) {
    for (const double distance :
         distances(position(element, index, ws), element.edges(ws.memory.segments[index])))
      g[i++] = distance;
  });
}

void pass_edges(const System& system, std::span<const int> found, Workspace& ws) {
  int event = 0;
  for_each_segmented(system, [&](const auto& element, int index) {
    int& segment = ws.memory.segments[index];
    auto [lower, upper] = distances(position(element, index, ws), element.edges(segment));
    if (std::ranges::binary_search(found, event++)) lower = 0;
    if (std::ranges::binary_search(found, event++)) upper = 0;
    if (upper <= 0)
      ++segment;
    else if (lower <= 0)
      --segment;
  });
}

}  // namespace wishbone
