#pragma once

#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "bodies/marker.h"
#include "bodies/modal_body.h"
#include "core/spatial.h"
#include "forces/applied_load.h"
#include "forces/force_element.h"
#include "forces/joint_drive.h"
#include "forces/joint_friction.h"
#include "forces/joint_limit.h"
#include "forces/joint_spring.h"
#include "forces/motion_signal.h"
#include "forces/spring_damper.h"
#include "forces/tire/tire.h"
#include "joints/cut_joint.h"
#include "joints/tree_joint.h"

namespace wishbone {

/// A body and the joint that carries it. The body frame B has its origin at the mass centre.
struct TreeBody {
  std::string name;
  std::string joint_name;
  bool floating = false;        ///< on a free joint that the scene does not name
  bool first_is_child = false;  ///< the joint's first-named body is this one, not the parent
  int parent = -1;  ///< index of the inboard body, always smaller than the own index; -1: the inertial frame
  int parent_interface =
      -1;                 ///< interface of a flexible parent that carries the joint; -1: the body itself does
  bool on_frame = false;  ///< whether that is a frame, which turns, rather than a node
  Pose
      X_PF;  ///< inboard joint frame on the parent, or on its interface (at a node only the rotation is used)
  Pose X_MB;  ///< body frame in the outboard joint frame
  bool turned_PF = false,
       turned_MB = false;  ///< whether these rotations are other than the identity, and so take part
  TreeJoint joint;
  int q_start = 0, v_start = 0;   ///< of the joint's coordinates and speeds
  int nq = 0, nv = 0;             ///< of the joint
  double mass = 0;                ///< [kg]
  Matrix3 J_B = Matrix3::Zero();  ///< about the mass centre, body axes [kg m^2]; unused for a flexible body
  int flexible = -1;              ///< index into System::flexible; -1: rigid
};

/// The elastic part of a tree body: its modal coordinates follow the joint's coordinates and speeds of that body.
struct FlexibleBody {
  ModalBody modal;
  int body = 0;                       ///< the tree body it belongs to
  int z_start = 0, z_rate_start = 0;  ///< where z and z' stand in q and v
  /// Tree joints hang on its interfaces, so its modal mass matrix is not the identity.
  bool carries_joints = false;
  std::vector<std::string>
      interface_names;  ///< numbers of nodes, names of frames, in the order of the ModalBody
};

/// A marker of the compiled scene: fixed to a body, or to an interface of a flexible one.
struct Marker {
  int body = -1;          ///< -1: the inertial frame
  int interface = -1;     ///< of a flexible body; -1: the body itself
  bool on_frame = false;  ///< whether that is a frame, which turns, rather than a node
  Pose X_BM;              ///< on the body, or on its interface (at a node only the rotation is used)
};

/// A cut joint between markers, and the bodies that feel its multipliers.
struct Closure {
  std::string name;
  CutJoint joint;
  /// Participants: on the first- and the second-named body, or those of a coupling.
  std::vector<MarkerIndex> markers;
  int row_start = 0, rows = 0;
  int column_start = 0;   ///< of its unit wrenches in Evaluation::W: `rows` columns for each participant
  int gauge_start = 0;    ///< of its gauges in Memory::closure_angles
  std::vector<int> path;  ///< bodies between any of the markers and the root, outermost first
};

/// A coordinate of a joint that is measured between two markers, to be recorded: of joints that close loops.
struct MeasuredCoordinate {
  std::string joint,
      name;  ///< name of the coordinate, "angle", "travel" ...; empty where the joint has one only
  Gauge gauge;
  MarkerIndex A = 0, B = 0;
};

/// Force elements by concrete type, so that the evaluation calls them without dispatch. A new force is one entry.
using ForceElements = std::tuple<std::vector<SpringDamper>, std::vector<Tire>, std::vector<AppliedLoad>,
                                 std::vector<JointSpring>, std::vector<JointFriction>,
                                 std::vector<JointLimit>, std::vector<JointDrive>>;

/// The compiled scene: what must be evaluated and nothing else. Immutable; every mutable number of an evaluation is in
/// a Workspace. Made by SystemBuilder.
struct System {
  Vector3 gravity = Vector3::Zero();
  std::vector<TreeBody> bodies;  ///< topological order
  std::vector<FlexibleBody> flexible;
  std::vector<Marker> markers;
  std::vector<Closure> closures;
  ForceElements forces;
  /// Variables 1, 2, ... of the functions of forces; variable 0 is the time.
  std::vector<MotionSignal> signals;
  std::vector<MeasuredCoordinate> measured;

  /// Factors on the speeds' shares in the metric in which the initial pose is assembled; empty: all one.
  VectorX assembly_weights;

  int nq = 0;         ///< coordinates q, modal ones included
  int nv = 0;         ///< speeds v
  int nx = 0;         ///< states of the force elements
  int n_rows = 0;     ///< closure rows, redundant ones included
  int n_columns = 0;  ///< unit wrenches of all closure rows on their markers
  int n_gauges = 0;   ///< of all closures
  int n_forces = 0;

  /// Of all bodies [kg].
  double total_mass() const;
  /// Name of a speed for messages, such as "front_left_wheel: wx" or "chassis: mode 3".
  std::string speed_name(int v_index) const;
  /// Name of a closure row, such as "rear_left_hinge_2 (x)".
  std::string row_name(int row) const;
  /// Times at which a prescribed motion or a load is only piecewise smooth [s], ascending.
  std::vector<double> stop_times() const;
};

/// Positions, speeds and force-element states at one time.
struct State {
  double t = 0;
  VectorX q, v, x;
};

}  // namespace wishbone
