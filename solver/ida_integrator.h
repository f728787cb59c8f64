#pragma once

#include <memory>

#include "solver/integrator.h"

namespace wishbone {

/// Form `ggl` on IDA: unknowns (q, v, x, work, Lambda, Gamma) with
///
///     q' = N(q) (v - D^T Gamma'),   M v' = f + D^T Lambda',   Phi(q) = 0,   D v + Phi_t = 0.
///
/// The multipliers enter as derivatives of their integrals, which makes the index 1: IDA can start and step it (as plain
/// unknowns it fails at the first step). lambda = Lambda'. [Gear, Gupta & Leimkuhler 1985; theory.md 2]
std::unique_ptr<Integrator> make_ida_integrator(const System& system, const IntegratorOptions& options,
                                                Workspace& ws, ProgressGuard& guard);

}  // namespace wishbone
