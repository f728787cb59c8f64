#pragma once

#include <Eigen/QR>
#include <vector>

#include "solver/evaluation.h"
#include "solver/work_counters.h"

namespace wishbone {

/// Articulated-body numbers of one body, world axes about Bo.
struct ArticulatedBody {
  Matrix3 J = Matrix3::Zero();  ///< of a rigid body alone
  Matrix6 P = Matrix6::Zero();  ///< articulated inertia; after factoring P+, as felt through the joint
  Vector6 Z = Vector6::Zero();  ///< articulated bias force; after calc_bias as felt through the joint at rest
};

/// Modal coordinates of one flexible body while they are condensed.
struct CondensedModes {
  explicit CondensedModes(const FlexibleBody& body);

  enum class Mass {
    unit,
    diagonal,
    full
  } mass = Mass::unit;  ///< what M_zz is, and which of the next two holds it
  VectorX diagonal;     ///< of M_zz, then of its Cholesky factor L_z
  MatrixX M_zz;         ///< then L_z (lower triangle); empty where it is never needed
  MatrixX Y;            ///< L_z^-1 M_zr, m x 6
  Matrix3X P_Psi;       ///< scratch: three rows of a child's P+ times the shapes of its interface

  /// x <- L_z^-1 x
  template <class Derived>
  void solve(Eigen::MatrixBase<Derived>& x) const {
    if (mass == Mass::full) M_zz.triangularView<Eigen::Lower>().solveInPlace(x);
    if (mass == Mass::diagonal) x.array().colwise() /= diagonal.array();
  }
  /// x <- L_z^-T x
  void solve_transposed(VectorX& x) const {
    if (mass == Mass::full) M_zz.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
    if (mass == Mass::diagonal) x.array() /= diagonal.array();
  }
};

/// Factor of D M^-1 D^T = U^T U for the rows that are solved for.
struct ClosureFactor {
  std::vector<int> kept;                   ///< independent rows, ascending
  MatrixX U;                               ///< nv x kept rows
  MatrixX S;                               ///< kept x kept; its Cholesky factor after factoring
  Eigen::ColPivHouseholderQR<MatrixX> qr;  ///< of U, where Cholesky would lose too many digits
  bool orthogonal = false;                 ///< whether qr is in use
  int rank = 0;  ///< rows that take part, all of them unless they have become dependent
  /// Smallest length that a row has orthogonal to those before it, by its scale: zero where the rank is lost.
  double least_sine = 1;
  int least_row = -1;  ///< the row it belongs to
  /// Of all rows, what their lengths (columns of U) are measured by; empty: the lengths themselves.
  VectorX scales;
  VectorX lengths;  ///< scales of the kept rows
  MatrixX scaled;   ///< U with columns divided by them
  VectorX scratch;
  VectorX solution;  ///< multipliers of the kept rows
};

/// Everything that solving for accelerations writes, sized once; solving allocates nothing.
struct Workspace : Evaluation<double> {
  explicit Workspace(const System& system);

  std::vector<ArticulatedBody> articulated;
  std::vector<CondensedModes> condensed;
  std::vector<Vector6> G;  ///< P H L^-T, a column for each speed of the joints
  VectorX inverse_root;    ///< 1/L_jj: of the root of the inertia that each speed of the joints moves
  VectorX v_rate;          ///< v'
  VectorX e;               ///< F tau, nv (articulated_body.h)
  VectorX hinge_force;     ///< generalised forces (nv), for Terms::hinge_forces
  VectorX stiffening;      ///< factor on the inertia that each speed moves, while assembling; empty: none
  ClosureFactor closure;
  VectorX lambda;        ///< all rows; zero for those not kept
  VectorX displacement;  ///< nv
  Matrix6X z;            ///< running wrenches of a closure sweep, 6 columns a body

  WorkCounters work;
};

/// All closure rows, ascending.
std::vector<int> all_rows(const System& system);
/// Those that are not among `kept` (ascending).
std::vector<int> redundant_rows(const System& system, const std::vector<int>& kept);

/// Makes `rows` (ascending) the closure rows that are solved for.
void keep_rows(const std::vector<int>& rows, const System& system, Workspace& ws);

}  // namespace wishbone
