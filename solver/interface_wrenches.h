#pragma once

#include "solver/workspace.h"

namespace wishbone {

/// What joints, springs, loads and all other force elements together exert on System::flexible[k], body axes [N m, N]: column i
/// on interface i, a node or a frame, the moment t_i about it above the force f_i; the last column (t_0, f_0) about Bo, of whatever
/// takes hold of the body as a whole. Gravity, which acts on every mass point, is not among them. They are what a static
/// analysis of the body with inertia relief is loaded with, for with b_i from Bo to the nodes
///     sum f_i + f_0                      = m a + alpha x c + P z'' + f_bias
///     sum (b_i x f_i + t_i) + t_0        = c x a + J alpha + S z'' + t_bias
///     sum Psi_i^T f_i                    = P^T a + S^T alpha + z'' + h_bias
/// with a = a_Bo - g (symbols of ModalBody; c, P and f_bias vanish with mean axes; a moment on a node loads no mode, since nodes
/// have translations only, one on a frame adds rotation^T J^T t).
/// After calc_reactions. F has interface_count() + 1 columns. Allocates nothing.
void calc_interface_wrenches(const System& system, int k, const Workspace& ws, Eigen::Ref<Matrix6X> F);

}  // namespace wishbone
