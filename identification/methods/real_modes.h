#pragma once

#include "core/spatial.h"

namespace wishbone {

/// The real modes nearest to complex ones, and how near they are.
struct RealModes {
  VectorX omega;               ///< m, |s| [rad/s]
  VectorX damping_ratio;       ///< m, -Re s / |s| [-]
  MatrixX shapes;              ///< r x m, the largest component of each positive
  VectorX phase_collinearity;  ///< m, MPC: 1 in phase or opposite, 0 a travelling wave [-]
  VectorX imaginary_share;     ///< m, what is left behind: |Im| / |psi| after rotation [-]
};

/// Turns each complex mode psi (column of `shapes`, any complex scale) of eigenvalue s by the phase that
/// makes its real part largest,
///     phi = -1/2 arg(sum_k psi_k^2),    shape = Re(e^{i phi} psi),
/// and takes omega = |s|, zeta = -Re s / |s|. A proportionally damped system gives back the modes,
/// frequencies and damping ratios of the undamped one. The modal phase collinearity is
///     MPC = |sum_k psi_k^2|^2 / (sum_k |psi_k|^2)^2
/// (Pappa, Elliott and Schenk, J. Guidance, Control and Dynamics 16 (1993), in closed form).
///
/// Throws InputError unless there is one eigenvalue for each mode, all numbers are finite, no eigenvalue is
/// zero and no shape is zero.
RealModes real_modes(const Eigen::VectorXcd& eigenvalues, const Eigen::MatrixXcd& shapes);

}  // namespace wishbone
