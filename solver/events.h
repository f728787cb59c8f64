#pragma once

#include <span>

#include "solver/workspace.h"

namespace wishbone {

/// Events known by state: a force element passes an edge of its segment, a wheel the edge of an obstacle, a joint a stop.
/// Every element that has segments has two event functions, its distances from the lower and the upper edge.
int event_count(const System& system);

/// Sets the segments for the current positions of the markers.
void initialize_segments(const System& system, Workspace& ws);

/// Values of all event functions, positive inside: only their falling through zero is an event. Needs update_markers.
void calc_events(const System& system, const Workspace& ws, std::span<double> g);

/// Moves elements on to their next segments: those whose events (ascending) were found, and those that stand on an edge or
/// beyond it. Two wheels that meet an edge together may differ by rounding, and of the later one, once it is beyond, no
/// fall is seen any more. Needs update_markers at the state of the event.
void pass_edges(const System& system, std::span<const int> found, Workspace& ws);

}  // namespace wishbone
