#pragma once

#include <optional>
#include <string>
#include <vector>

namespace wishbone {

/// A joint as an edge between two bodies; -1 is the ground.
struct GraphJoint {
  int first = -1, second = -1;
  int closure_rows = 0;     ///< what it costs where it closes a loop
  std::optional<bool> cut;  ///< pinned by the user; empty: free to choose
  bool preferred = false;   ///< has initial values of its own, which a cut joint cannot take
};

/// A body as a node.
struct GraphBody {
  bool floats = false;        ///< cannot be carried by a joint: it is a root of its own (a flexible body)
  bool first_choice = false;  ///< of the roots where a part of the mechanism has no tie to the ground
};

/// What becomes of a joint.
enum class JointRole {
  carries_second,  ///< tree joint, the second-named body hangs on the first
  carries_first,   ///< tree joint, traversed the other way
  closes           ///< cut joint
};

/// Spanning tree of the bodies with the fewest closure rows: the joints that would cost most are kept in the tree [Prim 1957],
/// among equal ones those nearest to the root, so that the tree is shallow, then in the order of the scene. Bodies that
/// nothing ties to the ground float: of a part of the mechanism without a flexible body, the body of first choice, else
/// one that no joint of the part names second, else its first. Pinned joints keep their role.
struct SpanningTree {
  std::vector<JointRole> roles;  ///< of the joints
  std::vector<int> carrier;      ///< of the bodies: the joint that carries it, -1 where it floats
  /// Joints pinned as tree joints that close a loop with other pinned ones; empty when all is well.
  std::vector<int> impossible;
};

SpanningTree span(const std::vector<GraphBody>& bodies, const std::vector<GraphJoint>& joints);

}  // namespace wishbone
