#include "solver/events.h"

#include <cmath>
#include <type_traits>

#include "solver/loads.h"

namespace wishbone {
namespace {

/// Calls f(tire, index of the force element) for every tire whose road has edges.
template <class F>
void for_each_segmented_tire(const System& system, F&& f) {
  for_each_force(system, [&](const auto& element, int index) {
    if constexpr (std::is_same_v<std::decay_t<decltype(element)>, Tire>)
      if (element.road().segment_count() > 1) f(element, index);
  });
}

double distance(double value) {
  return std::isfinite(value) ? value : 1.0;
}

}  // namespace

int event_count(const System& system) {
  int count = 0;
  for_each_segmented_tire(system, [&](const Tire&, int) { count += 2; });
  return count;
}

void initialize_segments(const System& system, Workspace& ws) {
  for_each_segmented_tire(system, [&](const Tire& tire, int index) {
    ws.memory.segments[index] = tire.road().segment_at(ws.markers[tire.wheel()].p_WM.x());
  });
}

void calc_events(const System& system, const Workspace& ws, std::span<double> g) {
  std::size_t i = 0;
  for_each_segmented_tire(system, [&](const Tire& tire, int index) {
    const double x = ws.markers[tire.wheel()].p_WM.x();
    g[i++] = distance(x - tire.road().lower_edge(ws.memory.segments[index]));
    g[i++] = distance(tire.road().upper_edge(ws.memory.segments[index]) - x);
  });
}

void handle_event(const System& system, int event, Workspace& ws) {
  int i = 0;
  for_each_segmented_tire(system, [&](const Tire&, int index) {
    if (i++ == event) --ws.memory.segments[index];
    if (i++ == event) ++ws.memory.segments[index];
  });
}

}  // namespace wishbone
