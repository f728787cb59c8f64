#pragma once

#include <vector>

#include "solver/system.h"

namespace wishbone {

/// Mutable numbers of one body in an evaluation. Vectors and matrices have world axes and are referred to the body
/// origin Bo; P is the parent's index.
struct BodyState {
  Pose X_WB;
  Vector3 p_PB = Vector3::Zero();  ///< from the parent's origin to Bo
  Vector3 p_MB = Vector3::Zero();  ///< from the outboard joint frame's origin to Bo
  Vector6 V = Vector6::Zero();     ///< V_WB
  Vector6 c = Vector6::Zero();     ///< A_WB - shift(A_WP) - H v': velocity products and prescribed motion
  Vector6 A = Vector6::Zero();     ///< A_WB
  Matrix6 H = Matrix6::Zero();     ///< hinge matrix, first nv columns
  Matrix6 P = Matrix6::Zero();     ///< articulated inertia
  Matrix6 L = Matrix6::Zero();     ///< Cholesky factor of D = H^T P H
  Matrix6 G = Matrix6::Zero();     ///< P H L^-T, first nv columns
  Vector6 Z = Vector6::Zero();     ///< articulated bias force
  Vector6 e = Vector6::Zero();     ///< L^-1 (hinge force), first nv entries
  Vector6 F_applied = Vector6::Zero();  ///< sum of applied wrenches, gravity included, about Bo
  Vector6 F_joint = Vector6::Zero();    ///< that the inboard joint exerts on the body, about Bo
};

/// Mutable numbers of one flexible body. Modal quantities are in body axes, the coupling in world axes.
struct FlexibleState {
  ModalBodyState modal;
  VectorX load;  ///< modal load Q = sum Psi_i^T f_i
  MatrixX
      M_zz;  ///< modal mass, identity plus what hangs on the nodes; its Cholesky factor after factoring (lower triangle)
  MatrixX Y;       ///< L_z^-1 M_zr, m x 6
  Matrix3X P_Psi;  ///< scratch: a child's P+ times the shapes of its node
  VectorX bias;    ///< z bias, then L_z^-1 of it
  VectorX z_dd;    ///< z''
};

/// Counts of work, the same on every machine.
struct WorkCounters {
  long position = 0, velocity = 0, forces = 0, inertia = 0, solves = 0, closure_factorizations = 0,
       projections = 0, inverse_dynamics = 0;
};

/// Everything that an evaluation writes, sized once; evaluating allocates nothing.
struct Workspace {
  explicit Workspace(const System& system);

  std::vector<BodyState> bodies;
  std::vector<FlexibleState> flexible;
  std::vector<MarkerState> markers;
  std::vector<MarkerAcceleration> marker_accelerations;
  std::vector<Wrench> wrenches;  ///< on the markers, of force elements (and multipliers once solved)
  std::vector<int> segments;     ///< discrete state of each force element, in the order of System::forces
  std::vector<double> element_powers;  ///< of each force element [W]

  VectorX v_rate;  ///< v'
  VectorX x_rate;  ///< rates of the force elements' states

  // closures
  std::vector<int> kept;          ///< independent rows, ascending
  VectorX Phi, Phi_rate, Phi_dd;  ///< all rows: residual, its rate, its second rate
  Matrix6X W_A, W_B;              ///< unit wrenches of all rows on their markers
  MatrixX U;                      ///< factor with D M^-1 D^T = U^T U, nv x kept rows
  MatrixX DMD;                    ///< kept x kept; its Cholesky factor after factoring
  VectorX rhs;                    ///< kept rows
  VectorX lambda;                 ///< all rows; zero for redundant ones
  VectorX displacement;           ///< nv
  Matrix6X z;                     ///< running wrenches of a closure sweep, 6 columns a body

  WorkCounters work;
};

/// Makes `rows` (ascending) the closure rows that are solved for.
void keep_rows(const std::vector<int>& rows, const System& system, Workspace& ws);

}  // namespace wishbone
