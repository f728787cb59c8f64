#pragma once

#include <string>
#include <vector>

#include "solver/mechanisms.h"

/// Small mechanisms around each part that a system can be made of, so that what holds for one part is tested for all.
namespace wishbone::testing {

struct NamedMechanism {
  std::string part;
  Built mechanism;
};

/// A floating body that carries another on the joint, rigidly and on a frame of a flexible one: every tree joint, from both
/// sides. All states are far from the design
/// pose and moving.
std::vector<NamedMechanism> around_every_tree_joint();

/// Floating bodies between which the closure stands open, rigid ones and frames of flexible ones: every cut joint, and a coupling of every gauge.
std::vector<NamedMechanism> around_every_cut_joint();

/// Floating bodies with the force element between them: every force, with every gauge, load axes and form of function.
std::vector<NamedMechanism> around_every_force();

/// All of these, one after the other.
std::vector<NamedMechanism> around_every_part();

/// All of them in one system, each with bodies of its own.
Built every_part_at_once();

}  // namespace wishbone::testing
