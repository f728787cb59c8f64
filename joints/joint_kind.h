#pragma once

#include <string_view>
#include <vector>

#include "bodies/gauge.h"

namespace wishbone {

/// The joints that can carry a body and close a loop alike.
enum class JointKind {
  fixed,
  revolute,
  prismatic,
  cylindrical,
  screw,
  universal,
  constant_velocity,
  spherical,
  planar,
  free
};

/// A coordinate of a joint, in the frame of the joint: z its axis (of a universal joint x the first and y the second axis,
/// of a planar one z the normal).
struct JointCoordinateKind {
  std::string_view name;  ///< "angle", "travel" ...
  bool is_angle = true;   ///< [rad] rather than [m]
  /// Whether `gauge` measures it, so that forces, couplings and drivers can act on it.
  bool measurable = true;
  Gauge gauge;
};

struct JointKindInfo {
  std::string_view name;  ///< in scenes and reports
  int closure_rows = 0;   ///< rows that the joint costs where it closes a loop
  std::vector<JointCoordinateKind> coordinates;
};

const JointKindInfo& info(JointKind kind);
/// By name; null when no kind is called so.
const JointKindInfo* find_info(std::string_view name);

}  // namespace wishbone
