#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bodies/interface_frame.h"
#include "bodies/mode_set.h"
#include "solver/given_speed.h"
#include "solver/system.h"

namespace wishbone {

/// Where something is attached: a body, or one node or frame of a flexible body. Body -1 is the inertial frame.
struct Attachment {
  int body = -1;
  int node_id = 0;  ///< id in the body's ModeSet; 0: no node
  int frame = -1;   ///< of the body's frames, as SystemBuilder::add_frame numbers them; -1: none
};

/// Puts a System together from bodies in their design pose. Joints, markers and cut joints are given where they are in that
/// pose, in inertial components; every joint coordinate is zero there. Bodies may be added in any order; a body that no
/// tree joint carries floats on a free joint.
class SystemBuilder {
 public:
  static constexpr int kGround = -1;

  Vector3 gravity = Vector3::Zero();  ///< [m/s^2]

  /// @param J_B inertia about the mass centre, body axes; X_WB design pose, origin at the mass centre
  int add_body(std::string name, double mass, const Matrix3& J_B, const Pose& X_WB);
  int add_flexible_body(std::string name, ShapeSet shapes, const Pose& X_WB,
                        InertiaTerms terms = InertiaTerms::consistent);
  /// @throws InputError if the modes are not valid (ModeSet::validate)
  int add_flexible_body(std::string name, const ModeSet& modes, const Pose& X_WB,
                        InertiaTerms terms = InertiaTerms::consistent);

  /// A frame over several nodes of a flexible body, where joints and forces may take hold that turn it; returns its number
  /// for Attachment::frame, from 0 for each body. Frames that nothing is attached to cost nothing.
  /// @throws InputError as frame_shapes does
  int add_frame(int body, InterfaceFrame frame);

  /// Initial velocity of a floating body: v_WBo inertial components [m/s], w_WB body components [rad/s].
  void set_velocity(int body, const Vector3& v_WB, const Vector3& w_WB_B);

  /// A speed that assembling keeps, unlike those of `set_velocity` and InitialMotion, which it changes where closures ask for
  /// it. Call when its body has its joint.
  void give(GivenSpeed speed);
  /// Velocities of a body, as in `set_velocity`, that assembling keeps.
  void give_velocity(int body, const std::optional<Vector3>& v_WB, const std::optional<Vector3>& w_WB_B,
                     const std::string& where);

  /// Initial values of a joint's coordinates and speeds (in the order of its v), and the factors on its speeds' shares in the
  /// metric in which the initial pose is assembled; what is left empty is zero, or one. Joints with quaternions start in the
  /// design pose.
  struct InitialMotion {
    std::vector<double> coordinates, speeds, weights;
  };

  /// Tree joint that carries `child` on `parent` at the point p_W. Axes have the components of the second-named body's axes,
  /// which is the child. `first_is_child`: the joint was named from child to parent; then it is given reversed
  /// (joints/tree_joint.h), and the parent is the second-named body.
  void add_joint(std::string name, Attachment parent, int child, const Vector3& p_W, TreeJoint joint,
                 InitialMotion initial = {}, bool first_is_child = false);
  void add_joint(std::string name, Attachment parent, int child, const Vector3& p_W, TreeJoint joint,
                 double coordinate, double speed = 0) {
    add_joint(std::move(name), parent, child, p_W, std::move(joint), {{coordinate}, {speed}, {}});
  }

  /// Cut joint between the markers of its participants.
  void add_closure(std::string name, std::vector<MarkerIndex> markers, CutJoint joint);
  void add_closure(std::string name, MarkerIndex A, MarkerIndex B, CutJoint joint) {
    add_closure(std::move(name), std::vector<MarkerIndex>{A, B}, std::move(joint));
  }

  /// Has a coordinate between two markers recorded.
  void measure(MeasuredCoordinate coordinate) { measured_.push_back(std::move(coordinate)); }

  /// Marker at p_W with axes R_WM in the design pose; on a node, at the node, with the axes of the body; on a frame carried
  /// along with it.
  MarkerIndex add_marker(Attachment on, const Vector3& p_W, const Matrix3& R_WM = Matrix3::Identity());
  /// Marker at an attachment's own origin (mass centre, node, or centre of a frame) with the body's axes.
  MarkerIndex add_marker(Attachment on);

  template <class Force>
  void add_force(Force force) {
    std::get<std::vector<Force>>(forces_).push_back(std::move(force));
  }

  /// A signal that functions of forces may use; returns its index among their variables, from 1.
  int add_signal(MotionSignal signal) {
    signals_.push_back(std::move(signal));
    return static_cast<int>(signals_.size());
  }

  const Pose& design_pose(int body) const { return bodies_[body].X_WB; }
  /// Design pose of an attachment: of its body, or the position of the node or of the frame's centre with the body's axes.
  Pose attachment_pose(Attachment on) const;

  /// The compiled system and its initial state (not yet assembled onto the closures).
  /// @throws InputError naming the body when a body has two tree joints, or the joints form a cycle
  std::pair<System, State> build() &&;

  /// What was given, for `assemble`; after build().
  const std::vector<GivenSpeed>& given() const { return given_; }

  /// Index in System::bodies of a body added here, after build().
  int built_index(int body) const { return order_of_[body]; }

 private:
  struct BodyEntry {
    std::string name;
    double mass;
    Matrix3 J_B;
    Pose X_WB;
    ShapeSet shapes;  // of a flexible body
    InertiaTerms terms = InertiaTerms::consistent;
    bool flexible = false;
    std::vector<InterfaceFrame> frames;
    std::vector<Vector3> frame_origins;
    std::vector<int> used_nodes,
        used_frames;  // ids and numbers, in the order of their first use: the interfaces
    Vector3 v_WB = Vector3::Zero(), w_WB_B = Vector3::Zero();
    int joint = -1;  // index in joints_
  };
  struct JointEntry {
    std::string name;
    Attachment parent;
    int child;
    Vector3 p_W;
    TreeJoint joint;
    InitialMotion initial;
    bool first_is_child;
  };

  struct MarkerEntry {
    Attachment on;
    Pose X_BM;
  };

  void use(Attachment on);
  int interface_index(Attachment on) const;
  /// Of ModalBody's interfaces: numbers of nodes, names of frames.
  static std::vector<std::string> interface_names(const BodyEntry& entry);
  ModalBody modal_body(const BodyEntry& entry) const;
  void add_markers(System& system) const;
  std::vector<int> topological_order() const;
  void add_tree_body(int entry, System& system, State& state);
  void find_paths(System& system) const;
  bool moves_freely(int body) const;

  std::vector<BodyEntry> bodies_;
  std::vector<JointEntry> joints_;
  std::vector<MarkerEntry> markers_;
  std::vector<Closure> closures_;
  ForceElements forces_;
  std::vector<MotionSignal> signals_;
  std::vector<MeasuredCoordinate> measured_;
  std::vector<GivenSpeed> given_;
  std::vector<int> order_of_;    // entry -> index in System::bodies
  std::vector<double> weights_;  // of the speeds, in the order of System
};

}  // namespace wishbone
