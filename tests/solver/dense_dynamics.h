#pragma once

#include "solver/workspace.h"

/// The equations of motion as dense matrices, for comparison with the recursions.
namespace wishbone::testing {

/// M(q) from kinetic energies alone: T is a quadratic function of v, so
/// M_ij = T(e_i + e_j) - T(e_i) - T(e_j) + T(0), whatever prescribed motions add to it.
MatrixX mass_matrix_from_energy(const System& system, const State& state);

/// D (rows x nv) by central differences of Phi along the directions of v.
MatrixX closure_jacobian_from_differences(const System& system, const State& state);

/// D (rows x nv), column by column of D^T as calc_closure_force gives it.
MatrixX closure_jacobian(const System& system, const State& state);

}  // namespace wishbone::testing
