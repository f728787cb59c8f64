#pragma once

#include <memory>

#include "solver/integrator.h"

namespace wishbone {

/// Forms `ode` and `index1` on CVODE: Adams-Moulton with functional iteration, or BDF with Newton, a dense
/// difference-quotient Jacobian and, for closed loops, CVODE's projection after each step.
std::unique_ptr<Integrator> make_cvode_integrator(const System& system, const IntegratorOptions& options,
                                                  Workspace& ws, ProgressGuard& guard);

}  // namespace wishbone
