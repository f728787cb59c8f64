#pragma once

#include "identification/methods/released_modes.h"

namespace wishbone {

/// Scatter of measured shapes: standard deviation of a component, relative to the root mean square of its shape.
struct ShapeScatter {
  double size = 0;   ///< [-]
  int products = 0;  ///< that it was found from; 0: nothing is known
};

/// Scatter of the shapes from the modes themselves. Of exact modes on a support these products vanish,
///     psi_i^T M_t psi_j = 0, i < j        (mass orthogonality, M_t = M + M_s)
///     w^T (lambda_j M_t - K_s) psi_j = 0   (equilibrium, for every rigid motion w that no joint resists)
/// and independent errors s r_j of every component of psi_j, r_j its root mean square, give them the standard deviations
///     s (r_j^2 |M_t psi_i|^2 + r_i^2 |M_t psi_j|^2)^1/2   and   s r_j |(lambda_j M_t - K_s) w|
/// to first order. So every product over its deviation is one sample of s: their median absolute value over 0.6745, that
/// of the normal distribution, is the estimate. The median does not care for few products that are wrong for another
/// reason: equilibrium of nearly rigid modes on springs that are stated wrongly, or a mode that was measured twice.
///
/// Where symmetry makes most products vanish the median is none; what is known then is how many digits were written
/// (written_scatter). That much counts as far as the root mean square of the samples shows it: numbers of few digits may
/// also be exact.
///
/// `fitted`: number of masses that were fitted to these products, which takes as much freedom from them.
/// `measured`: modes of any scale, as they were read; `rigid`: Psi_0, M-orthonormal.
///
/// Source of the robust deviation: P. J. Huber, E. M. Ronchetti, Robust Statistics, 2nd ed. 2009, section 5.1.
ShapeScatter shape_scatter(const Modes& measured, const SparseMatrix& M, const SupportMatrices& support,
                           const MatrixX& rigid, int fitted = 0);

/// Scatter that numbers written with few digits have: an error of rounding, uniform over one unit q of the last place,
/// has the deviation q / sqrt(12). The digits are the fewest with which every number is written in full, to 12 of them;
/// the largest deviation of all shapes counts. Zero where shapes have as many digits as a double.
double written_scatter(const MatrixX& shapes);

}  // namespace wishbone
