#pragma once

#include <map>
#include <utility>
#include <vector>

#include "joints/motion.h"
#include "models/scene.h"
#include "models/spanning_tree.h"
#include "solver/system_builder.h"

namespace wishbone {

/// Puts the joints and closures of a scene into a SystemBuilder that has its bodies: chooses the spanning tree, turns tree joints
/// that are traversed the other way, and adds the forces on joint coordinates.
class JointCompiler {
 public:
  JointCompiler(const Scene& scene, SystemBuilder& builder);

  void add_joints();
  void add_closures();
  /// Hands on the speeds and velocities that the scene gives. Call last.
  void give_speeds();
  /// Rows that hold the given positions of joints that close loops; returns whether there are any.
  bool guide_positions();

  const SpanningTree& tree() const { return tree_; }
  /// The body that a tree joint carries (index in the scene).
  int carried_body(int joint) const;

  /// A new marker at a point, with axes given in the design frame.
  MarkerIndex marker(const Scene::Point& point, const Matrix3& R_DM = Matrix3::Identity());
  /// The markers of a joint on its first- and its second-named body, between which its coordinates are measured.
  std::pair<MarkerIndex, MarkerIndex> markers(int joint);

 private:
  Matrix3 second_axes(const Scene::Joint& joint) const;
  TreeJoint tree_joint(const Scene::Joint& joint) const;
  CutJoint cut_joint(const Scene::Joint& joint) const;
  Motion motion(int index) const;
  void add_to_tree(int joint, bool forward);
  void cut(int joint);
  void drive(int joint, std::size_t coordinate);
  void add_forces(int joint);
  void add_coupling(const Scene::Closure& closure);
  void give_speed(int joint, std::size_t coordinate, double value);
  void give_spin(int joint);

  const Scene& scene_;
  SystemBuilder& builder_;
  SpanningTree tree_;
  std::map<int, std::pair<MarkerIndex, MarkerIndex>> markers_;  // of joints that need them
};

}  // namespace wishbone
