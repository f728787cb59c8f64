#pragma once

#include <span>

#include "solver/workspace.h"

namespace wishbone {

/// Events known by state: a wheel reaches an edge of its road segment. Every tire on a segmented road has two event functions,
/// the distances of the wheel centre's x from the lower and the upper edge of the active segment.
int event_count(const System& system);

/// Sets the discrete states for the current positions of the markers.
void initialize_segments(const System& system, Workspace& ws);

/// Values of all event functions, positive inside: only their falling through zero is an event. Needs update_markers.
void calc_events(const System& system, const Workspace& ws, std::span<double> g);

/// Moves the element that owns the event on to its next segment.
void handle_event(const System& system, int event, Workspace& ws);

}  // namespace wishbone
