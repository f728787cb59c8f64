#pragma once

#include <string>
#include <vector>

#include "identification/methods/modes.h"

namespace wishbone {

/// Where a mode of a flexible body comes from.
enum class ModeKind {
  normal,          ///< a mode of the free body
  attachment,      ///< what a force on an interface freedom adds (attachment_modes.h)
  constraint,      ///< what a displacement of an interface freedom adds (constraint_modes.h)
  fixed_interface  ///< what a vibration with the interfaces held adds (fixed_interface_modes.h)
};
const char* to_string(ModeKind kind);

/// The kind that has most of a mode's energy, which parts of these kinds share.
ModeKind largest_share(const VectorX& energy, const std::vector<ModeKind>& kinds);

/// Modes of a reduced body, of unit modal mass and with the diagonal stiffness diag(lambda).
struct CombinedModes {
  Modes modes;  ///< ascending, orthogonal to rigid motion
  std::vector<ModeKind>
      kinds;                  ///< of each; one that several kinds share has that of most of its strain energy
  Eigen::Index left_out = 0;  ///< shapes that added nothing to the others
};

/// Normal modes and static shapes as one set of modes: a basis of all that they span but for rigid motion,
///     Psi^T M Psi = 1,   Psi^T K Psi = diag(lambda),   Psi_0^T M Psi = 0.
/// It gives the statics and dynamics of Ritz's method in that span; with all attachment modes of a freedom among them,
/// the static flexibility there is exact however few normal modes are kept.
///
/// The kept modes stay as they are. What the static shapes add to them, x <- (1 - Psi_0 Psi_0^T M - Psi Psi^T M) x,
/// is coupled with them by neither M nor K, since K psi = lambda M psi. Of this remainder a direction is left out when
/// its strain energy is below 1e-12 of that of the shapes (each given the same energy first): its share of a static
/// deflection would be 1e-12 too. The rest is made K-orthonormal, E^T K E = 1, and
///     (E^T M E) y = (1 / lambda) y,   psi = E y sqrt(lambda)
/// completes the set. This reciprocal form of the Rayleigh-Ritz problem keeps the lowest of these modes accurate,
/// whose frequencies may be 10^4 times below the highest.
///
/// K, M (n x n); `rigid` Psi_0 (n x k) M-orthonormal; `kept` modes of K and M, of unit modal mass and orthogonal to
/// Psi_0; `attachment` and `constraint` (n x any) static shapes of any scale, of which there may be none, and likewise
/// modes of the body held at its interfaces, `fixed_interface`.
/// Throws InputError if the kept modes are no modes of K and M.
///
/// Source: R. R. Craig, A. J. Kurdila, Fundamentals of Structural Dynamics, 2nd ed. 2006, chapter 17.
CombinedModes combined_modes(const SparseMatrix& K, const SparseMatrix& M, const MatrixX& rigid,
                             const Modes& kept, const MatrixX& attachment, const MatrixX& constraint,
                             const MatrixX& fixed_interface = {});

}  // namespace wishbone
