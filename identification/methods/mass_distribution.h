#pragma once

#include "identification/methods/modes.h"

namespace wishbone {

/// Mass properties of a body, about any origin for the centre and about the centre for the inertia.
struct RigidBodyData {
  double mass = 0;                    ///< > 0 [kg]
  Vector3 centre = Vector3::Zero();   ///< [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about the mass centre, J = sum m_i (|s_i|^2 1 - s_i s_i^T) [kg m2]
};

/// Nodal masses and how well they are determined.
struct MassDistribution {
  VectorX node_mass;    ///< n, >= 0 [kg]
  int rank = 0;         ///< of the equations; n when they determine every mass
  double residual = 0;  ///< |A x - b| / |b| of the scaled equations
  int equations = 0;
};

/// Lumped masses x >= 0 of n nodes from the mass properties of the body and the orthogonality of its modes
/// [6.4-6.10]:
///     sum x_k = m,   sum x_k s_k = 0,   sum x_k (|s_k|^2 1 - s_k s_k^T) = J,        s_k about the mass centre
///     sum x_k psi_ik . psi_jk = -psi_i^T M_s psi_j,   i < j,
/// scaled, in the least-squares sense with x >= 0; of the least norm where they leave masses open
/// (by a regularisation at rounding level). `shapes` (3n x m): node by node in x, y, z, any scale; M_s: masses of
/// the support (3n x 3n).
/// Throws InputError if sizes do not fit, mass or inertia are not positive.
MassDistribution distribute_mass(const RigidBodyData& body, const Matrix3X& node_position,
                                 const MatrixX& shapes, const SparseMatrix& M_s);

}  // namespace wishbone
