#pragma once

#include <memory>

#include "solver/integrator.h"

namespace wishbone {

/// Forms `ode` and `index1` on ARKODE's explicit Runge-Kutta steppers, with projection onto the closures after each step.
/// The cheapest choice for loops without stiffness [design: Andrews' mechanism, explicit pairs beat every multistep form].
std::unique_ptr<Integrator> make_erk_integrator(const System& system, const IntegratorOptions& options,
                                                Workspace& ws, ProgressGuard& guard);

}  // namespace wishbone
