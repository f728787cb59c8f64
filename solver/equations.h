#pragma once

#include <memory>

#include "solver/first_order.h"
#include "solver/integrator.h"

namespace wishbone {

/// The equations of motion in the form that the options ask for (ode, index1 or partition).
std::unique_ptr<FirstOrderSystem> make_equations(const System& system, const IntegratorOptions& options,
                                                 Workspace& ws, ProgressGuard& guard);

}  // namespace wishbone
