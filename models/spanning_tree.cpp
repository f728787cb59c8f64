#include "models/spanning_tree.h"

#include <algorithm>
#include <tuple>

namespace wishbone {
namespace {

constexpr int kGround = -1;

class Prim {
 public:
  Prim(const std::vector<GraphBody>& bodies, const std::vector<GraphJoint>& joints)
      : bodies_(bodies), joints_(joints), depth_(bodies.size(), -1) {
    tree_.roles.assign(joints.size(), JointRole::closes);
    tree_.carrier.assign(bodies.size(), -1);
  }

  SpanningTree span() && {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (bodies_[b].floats) depth_[b] = 0;
    grow();
    while (add_root()) grow();
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j].cut == false && tree_.roles[j] == JointRole::closes)
        tree_.impossible.push_back(static_cast<int>(j));
    return std::move(tree_);
  }

 private:
  bool reached(int body) const { return body == kGround || depth_[body] >= 0; }
  int depth(int body) const { return body == kGround ? 0 : depth_[body]; }

  /// Adds the best joint between a reached body and another one until there is none.
  void grow() {
    for (;;) {
      int best = -1;
      for (std::size_t j = 0; j < joints_.size(); ++j)
        if (crosses(joints_[j]) && (best < 0 || better(static_cast<int>(j), best)))
          best = static_cast<int>(j);
      if (best < 0) return;
      const GraphJoint& joint = joints_[best];
      const bool forward = reached(joint.first);
      const int parent = forward ? joint.first : joint.second, child = forward ? joint.second : joint.first;
      tree_.roles[best] = forward ? JointRole::carries_second : JointRole::carries_first;
      tree_.carrier[child] = best;
      depth_[child] = depth(parent) + 1;
    }
  }

  bool crosses(const GraphJoint& joint) const {
    return joint.cut != true && reached(joint.first) != reached(joint.second);
  }

  /// Pinned ones first, then those with initial values, then by rows, then by the depth of the body they hang on.
  bool better(int a, int b) const {
    const auto rank = [&](const GraphJoint& j) {
      const int hangs_on = reached(j.first) ? j.first : j.second;
      return std::tuple(j.cut == false, j.closure_rows, j.preferred, -depth(hangs_on));
    };
    return rank(joints_[a]) > rank(joints_[b]);
  }

  /// Makes a body of a part that is not reached yet float.
  bool add_root() {
    const auto unreached = std::find(depth_.begin(), depth_.end(), -1);
    if (unreached == depth_.end()) return false;
    const std::vector<int> part = connected(static_cast<int>(unreached - depth_.begin()));
    const auto first_choice =
        std::find_if(part.begin(), part.end(), [&](int b) { return bodies_[b].first_choice; });
    const auto natural = std::find_if(part.begin(), part.end(), [&](int b) { return !named_second(b); });
    const auto root = first_choice != part.end() ? first_choice : natural;
    depth_[root != part.end() ? *root : part.front()] = 0;
    return true;
  }

  bool named_second(int body) const {
    return std::any_of(joints_.begin(), joints_.end(),
                       [&](const GraphJoint& j) { return j.cut != true && j.second == body; });
  }

  /// Bodies that joints of the tree can tie to `start`, ascending.
  std::vector<int> connected(int start) const {
    std::vector<int> part{start};
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const GraphJoint& j : joints_) {
        if (j.cut == true || (j.first != part[i] && j.second != part[i])) continue;
        const int other = j.first == part[i] ? j.second : j.first;
        if (other == kGround || std::find(part.begin(), part.end(), other) != part.end()) continue;
        part.push_back(other);
      }
    std::sort(part.begin(), part.end());
    return part;
  }

  const std::vector<GraphBody>& bodies_;
  const std::vector<GraphJoint>& joints_;
  std::vector<int> depth_;  // -1: not reached
  SpanningTree tree_;
};

}  // namespace

SpanningTree span(const std::vector<GraphBody>& bodies, const std::vector<GraphJoint>& joints) {
  return Prim(bodies, joints).span();
}

}  // namespace wishbone
