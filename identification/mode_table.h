#pragma once

#include <vector>

#include "bodies/mode_set.h"
#include "identification/methods/combined_modes.h"

namespace wishbone {

/// What is worth knowing of one mode of a flexible body.
struct ModeRow {
  ModeKind kind = ModeKind::normal;
  double frequency = 0;       ///< [Hz]
  double damping_ratio = 0;   ///< [-]
  double effective_mass = 0;  ///< [kg]
  int node = 0;               ///< where it is felt most: the effective mass is that at this node
};

/// A row for every mode. The effective mass at a node is what the mode opposes to a force there that acts along its own
/// motion, 1 / |Psi_i|^2 for modes of unit modal mass; it is given for the one of `nodes` (of all when none is named)
/// where it is least, and infinite for a mode that moves none of them. (The effective masses of held structures, taken
/// from the reaction of the support, are zero in a free one: its elastic modes move neither the mass centre nor, as a
/// whole, the axes.)
std::vector<ModeRow> mode_table(const ModeSet& set, const std::vector<ModeKind>& kinds,
                                const std::vector<int>& nodes);

/// Kinds of modes (of unit modal mass) that are combinations of others of the same nodes: each has that of most of
/// its strain energy, sum_i (omega_i psi_i^T M psi)^2 over the modes psi_i of a kind.
std::vector<ModeKind> inherited_kinds(const ModeSet& combined, const ModeSet& from,
                                      const std::vector<ModeKind>& kinds);

}  // namespace wishbone
