#pragma once

#include <string_view>

namespace wishbone::mode_file_layout {

/// Attribute `kind` of /meta.
constexpr std::string_view kKind = "mode set";
/// Attribute `layout` of /meta. A reader refuses a larger one.
constexpr double kLayout = 1;

// Datasets, relative to the group of the modes.
constexpr auto kNodeId = "nodes/id";
constexpr auto kNodePosition = "nodes/position";
constexpr auto kNodeMass = "nodes/mass";
constexpr auto kFrequency = "modes/frequency";
constexpr auto kAngularFrequency = "modes/angular_frequency";
constexpr auto kDampingRatio = "modes/damping_ratio";
constexpr auto kModalMass = "modes/modal_mass";
constexpr auto kShapes = "modes/shapes";
constexpr auto kFreedomNode = "modes/freedom_node";
constexpr auto kFreedomAxis = "modes/freedom_axis";
constexpr auto kSprings = "support/springs";
constexpr auto kJoints = "support/joints";
constexpr auto kMasses = "support/masses";
constexpr auto kLines = "lines";

}  // namespace wishbone::mode_file_layout
