#pragma once

#include "core/error.h"
#include "solver/workspace.h"

namespace wishbone {

/// What it comes from that no step succeeds (StepsFailed), as far as the state tells in which the run stopped; other errors say
/// themselves what they come from. Next to a singular position into which a motion drives the mechanism it is the motion: beyond
/// it no pose follows. Where no step helps (HopelessRun), the force that exerts most is where to look first.
/// @param t  end of the last step [s]
/// @param x  states of force elements
NumericsError explained(const NumericsError& error, const System& system, double t, const VectorX& x,
                        const Workspace& ws);

}  // namespace wishbone
