#pragma once

#include <exception>
#include <string>

#include "core/spatial.h"
#include "solver/first_order.h"

namespace wishbone {

/// Throws what stopped an integrator: the error that an element raised in a callback if there was one (with the time added),
/// otherwise a StepsFailed that names the coordinate with the largest weighted entry of `blame`.
[[noreturn]] void throw_integrator_failure(FirstOrderSystem& equations, const std::string& integrator,
                                           const std::string& flag, double t, const VectorX& blame);

}  // namespace wishbone
